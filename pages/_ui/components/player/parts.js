// The parts of a replay that the browser holds, and the columns made of them.
//
// Python names the parts that it knows of and sends those that a commit does not list as
// held; so a changed header of a column costs the part that is new, and no more.

const HELD_BYTES = 1e8; // of parts that are kept; the oldest not in use go first

// Decoded parts by id, shared by all players of this page.
const held = new Map();

const DECODERS = {
  scene: async (bytes) => {
    const scene = decodeScene((await inflated(bytes)).buffer);
    return { ...scene, picture: await pictureOf(scene.preview).catch(() => null) };
  },
  log: async (bytes) => decodeLog((await inflated(bytes)).buffer),
  walls: async (bytes) => decodeWalls((await inflated(bytes)).buffer),
  beams: async (bytes) => decodeBeams((await inflated(bytes)).buffer),
};

async function holdParts(parts, payloads) {
  const isNew = ({ id }, i) => payloads[i].length > 0 && !held.has(id);
  const decode = async (part, i) =>
    isNew(part, i) ? [[part.id, await DECODERS[part.kind](payloads[i])]] : [];
  for (const [id, part] of (await Promise.all(parts.map(decode))).flat()) held.set(id, part);
  dropParts(new Set(parts.map(({ id }) => id)));
}

function dropParts(inUse) {
  let bytes = [...held.values()].reduce((sum, part) => sum + bytesOf(part), 0);
  for (const id of [...held.keys()].filter((one) => !inUse.has(one))) {
    if (bytes <= HELD_BYTES) return;
    bytes -= bytesOf(held.get(id));
    held.get(id).picture?.close();
    held.delete(id);
  }
}

// Of a part that is one array, or an object of arrays.
const bytesOf = (part) =>
  part.byteLength ?? Object.values(part).reduce((sum, value) => sum + (value?.byteLength ?? 0), 0);

const heldParts = () => [...held.keys()];

// The ids of parts by what they are. Those of an earlier header stay known while the
// building and the sensor are the same: a choice taken back needs nothing from Python.
function learnParts(p, { base, parts }) {
  if (p.base !== base) Object.assign(p, { base, ids: new Map(), logs: new Map() });
  for (const { kind, name, id } of parts) p.ids.set(`${kind} ${name}`, id);
}

const partNamed = (p, name) => held.get(p.ids.get(name));

const countsBeams = ({ model }) => model === "hits_visits";

const logName = (setting) =>
  `log ${countsBeams(setting) ? "counts" : setting.behind_hit} ${setting.cell_px}`;

const wallsName = ({ prior_drawing, flaw, cell_px }) => `walls ${prior_drawing} ${flaw} ${cell_px}`;

const namesOf = (setting) => [logName(setting), wallsName(setting)];

const isHeld = (p, setting) => namesOf(setting).every((name) => partNamed(p, name));

// The log of a column's sensor reading and cell size, at the step of all others.
function logOf(p, setting) {
  const id = p.ids.get(logName(setting));
  if (!p.logs.has(id)) {
    const evidence = held.get(id);
    p.logs.set(id, newLog(countsBeams(setting) ? countsOfBeams(evidence, p.header.constants) : evidence));
  }
  const log = p.logs.get(id);
  seek(log, p.state.step);
  return log;
}

// The columns of the settings; one whose log and walls are as before stays the same.
function assembleColumns(p) {
  const before = p.columns ?? [];
  p.columns = p.state.columns.map((setting, i) => {
    const log = logOf(p, setting);
    const drawn = partNamed(p, wallsName(setting));
    const same = before[i]?.log === log && before[i].drawn === drawn;
    return same ? before[i] : newColumn(log, drawn, p.header.constants);
  });
  const inUse = new Set(p.columns.map(({ log }) => log));
  for (const [id, log] of p.logs) if (!inUse.has(log)) p.logs.delete(id);
}
