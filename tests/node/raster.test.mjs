import assert from "node:assert/strict";
import { test } from "node:test";
import { load, seeded } from "./scripts.mjs";

const board = load("board");

const blank = (width, height) => ({ width, height, pixels: new Uint8Array(width * height) });

const rowsOf = (grid) =>
  Array.from({ length: grid.height }, (_, row) =>
    grid.pixels.subarray(row * grid.width, (row + 1) * grid.width).join(""),
  );

function drawn(kind, points, width = 1, size = [8, 6]) {
  const grid = blank(...size);
  const box = board.applyStroke(grid, { kind, width, points });
  return { grid, box, rows: rowsOf(grid) };
}

test("a dot of one pixel covers the pixel that it lies in", () => {
  const { rows, box } = drawn("brush", [[3.9, 2.1]]);
  assert.deepEqual(rows, ["00000000", "00000000", "00010000", "00000000", "00000000", "00000000"]);
  assert.deepEqual(box, { x0: 3, y0: 2, x1: 4, y1: 3 });
});

test("a line of width 2 along the centres of pixels covers two rows", () => {
  const { rows } = drawn("line", [[1.5, 2.5], [6.5, 2.5]], 2);
  const full = rows.map((row) => row.slice(2, 6) === "1111");
  assert.deepEqual(full, [false, true, true, false, false, false]);
});

test("a filled rectangle covers the pixels whose test points lie in it", () => {
  const { rows } = drawn("rectangle", [[5, 4], [2, 1]]);
  assert.deepEqual(rows, ["00000000", "00111000", "00111000", "00111000", "00000000", "00000000"]);
});

test("an outline leaves the inside free", () => {
  const { rows } = drawn("outline", [[1, 1], [7, 5]], 2);
  assert.deepEqual(rows, ["11111111", "11111111", "11000011", "11000011", "11111111", "11111111"]);
});

test("an eraser writes another value than a brush, over it as well", () => {
  const grid = blank(6, 3);
  board.applyStroke(grid, { kind: "rectangle", width: 1, points: [[0, 0], [6, 3]] });
  board.applyStroke(grid, { kind: "clear", width: 1, points: [[2, 1], [4, 3]] });
  assert.deepEqual(rowsOf(grid), ["111111", "112211", "112211"]);
});

test("what lies outside the drawing has no effect and no box", () => {
  const { grid, box } = drawn("brush", [[-20, -20], [-10, 40]], 4);
  assert.equal(grid.pixels.indexOf(1), -1);
  assert.ok(board.isEmptyBox(box));
});

// The definition itself, asked for every pixel.
test("a line covers the pixels whose test points lie within half its width", () => {
  const random = seeded(3);
  for (let k = 0; k < 200; k++) {
    const point = () => [random() * 40 - 5, random() * 30 - 5];
    const [a, b, width] = [point(), point(), 1 + random() * 12];
    const { grid } = drawn("line", [a, b], width, [30, 20]);
    for (let row = 0; row < 20; row++) {
      for (let col = 0; col < 30; col++) {
        const distance = board.distanceToSegment([col + board.TEST_POINT, row + board.TEST_POINT], a, b);
        const holdsEnd = [a, b].some(([x, y]) => Math.floor(x) === col && Math.floor(y) === row);
        if (Math.abs(distance - width / 2) < 1e-9) continue; // decided by rounding
        const expected = distance < width / 2 || holdsEnd ? 1 : 0;
        assert.equal(grid.pixels[row * 30 + col], expected, `${a} ${b} ${width} at ${col}, ${row}`);
      }
    }
  }
});

test("a simplified line stays within its tolerance and keeps its ends", () => {
  const random = seeded(5);
  const line = Array.from({ length: 300 }, (_, i) => [i, 20 * Math.sin(i / 20) + random()]);
  const few = board.simplified(line, 1.5);
  assert.ok(few.length < 80);
  assert.deepEqual([few[0], few.at(-1)], [line[0], line.at(-1)]);
  for (const p of line) {
    const distances = few.slice(1).map((q, i) => board.distanceToSegment(p, few[i], q));
    assert.ok(Math.min(...distances) <= 1.5);
  }
});

test("a long scribble is simplified until it has as few points as are allowed", () => {
  const random = seeded(6);
  const scribble = Array.from({ length: 5000 }, () => [random() * 100, random() * 100]);
  assert.ok(board.atMost(200, scribble, 0.5).length <= 200);
});

test("the parts of a path in walls begin and end at their edges", () => {
  const grid = blank(20, 5);
  for (let row = 0; row < 5; row++) grid.pixels.fill(1, row * 20 + 8, row * 20 + 12);
  const [part, ...others] = board.partsInside(grid, [[2, 2.5], [18, 2.5]]);
  assert.equal(others.length, 0);
  assert.ok(Math.abs(part[0][0] - 8) <= 0.5);
  assert.ok(Math.abs(part[1][0] - 12) <= 0.5);
});

test("a straight line turns to the nearest of eight directions", () => {
  const near = (p, q) => p.every((value, axis) => Math.abs(value - q[axis]) < 1e-9);
  assert.ok(near(board.turnedTo45([0, 0], [10, 1]), [10, 0]));
  assert.ok(near(board.turnedTo45([5, 5], [8, 9]), [8.5, 8.5]));
});
