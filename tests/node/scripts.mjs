// Loads a component's scripts as the browser gets them: one scope, the same order.

import { readFileSync } from "node:fs";
import { fileURLToPath } from "node:url";
import vm from "node:vm";

const COMPONENTS = fileURLToPath(new URL("../../pages/_ui/components/", import.meta.url));

// The order stands once, in the Python that joins the scripts.
function listed(python, name) {
  const [, names] = readFileSync(COMPONENTS + python, "utf8").match(
    new RegExp(`^${name} = \\(([^)]*)\\)`, "m"),
  );
  return [...names.matchAll(/\*(\w+)|"([\w./]+)"/g)].flatMap(([, list, one]) =>
    list ? listed("__init__.py", list) : [one],
  );
}

// What the scripts define, by name.
export function load(component) {
  const shared = listed("__init__.py", "SHARED_SCRIPTS").map((name) => `shared/${name}`);
  const own = listed(`${component}/__init__.py`, "SCRIPTS").map((name) =>
    name.includes("/") ? name : `${component}/${name}`,
  );
  for (const path of [...shared, ...own]) {
    const text = readFileSync(COMPONENTS + path, "utf8");
    const script = text.replace("export default function", "globalThis.start = function");
    vm.runInThisContext(`"use strict";${script}`, { filename: COMPONENTS + path });
  }
  return new Proxy({}, { get: (_, name) => vm.runInThisContext(name) });
}

// Numbers that look random and are the same in each run (mulberry32).
export function seeded(seed) {
  return () => {
    seed = (seed + 0x6d2b79f5) | 0;
    let t = Math.imul(seed ^ (seed >>> 15), 1 | seed);
    t = (t + Math.imul(t ^ (t >>> 7), 61 | t)) ^ t;
    return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
  };
}
