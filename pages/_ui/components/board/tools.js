// The tools of each mode: label, hint and icon.

const STRAIGHT = "Shift keeps to 0, 45 and 90 degrees.";
const TOOLS = {
  brush: {
    label: "Brush", key: "b", width: 8, start: freeLine("brush"),
    hint: "Drag to add wall.",
    icon: '<path d="M14.5 4.5 19.5 9.5 11 18l-5-5zM6 13l5 5c-1.6 2-4.4 2.6-7.5 2 1.8-1.6.6-4.2 2.5-7z"/>',
  },
  line: {
    label: "Straight line", key: "l", width: 4, start: twoPoints("line"),
    hint: `Drag from end to end to add a straight wall. ${STRAIGHT}`,
    icon: '<path d="M5.5 18.5 18.5 5.5"/><circle cx="4.5" cy="19.5" r="1.8"/><circle cx="19.5" cy="4.5" r="1.8"/>',
  },
  rectangle: {
    label: "Filled rectangle", key: "r", start: twoPoints("rectangle"),
    hint: "Drag from corner to corner to fill a rectangle with wall.",
    icon: '<path class="fill" d="M4 6h16v12H4z"/>',
  },
  outline: {
    label: "Room outline", key: "o", width: 4, start: twoPoints("outline"),
    hint: "Drag from corner to corner to add the four walls of a room.",
    icon: '<path d="M4 6h16v12H4z"/>',
  },
  eraser: {
    label: "Eraser", key: "e", width: 12, start: freeLine("eraser"),
    hint: "Drag to erase wall.",
    icon: '<path d="M9.5 19.5 4 14 14 4l6.5 6.5-9 9zM8.5 9.5l6.5 6.5M9 20h11"/>',
  },
  clear: {
    label: "Clear rectangle", key: "c", start: twoPoints("clear"),
    hint: "Drag from corner to corner to erase all wall in a rectangle.",
    icon: '<path stroke-dasharray="3 2.2" d="M4 6h16v12H4z"/><path d="m9.5 9.5 5 5m0-5-5 5"/>',
  },
  accept: {
    label: "Accept a doubtful piece", key: "a", start: decideOne(ADDED), clicks: true,
    hint: "Click a hatched piece to make it wall; N goes to the next.",
    icon: '<path d="m4 13 5 5L20 6"/>',
  },
  reject: {
    label: "Remove a doubtful piece", key: "d", start: decideOne(ERASED), clicks: true,
    hint: "Click a hatched piece to remove it; N goes to the next.",
    icon: '<path d="m5.5 5.5 13 13m0-13-13 13"/>',
  },
  waypoints: {
    label: "Waypoints", key: "w", start: waypoints, clicks: true,
    hint: "Click to add a point, on the path to insert one; drag to move, right-click or hold to delete.",
    icon: '<path d="M6.8 16.6 9.5 9M12.6 8.6l3.6 5.6"/><circle cx="6" cy="18.5" r="2"/><circle cx="10.5" cy="6.8" r="2"/><circle cx="17.5" cy="16" r="2"/>',
  },
  freehand: {
    label: "Free hand", key: "f", start: freehand,
    hint: "Drag along the robot's path; a new stroke continues from its end.",
    icon: '<path d="M4 17c2.5-9 5.5-12 7-9.5S8.5 15 11 16s4-8 6-7 .5 5 3 6"/>',
  },
  ruler: {
    label: "Ruler", key: "m", start: ruler, clicks: true,
    hint: `Click both ends, or drag from one to the other. ${STRAIGHT}`,
    icon: '<path d="M3.5 15.5 15.5 3.5l5 5-12 12zM7 12l2 2m1-5 3 3m0-6 2 2"/>',
  },
  frame: {
    label: "Crop", key: "x", start: frame,
    hint: "Drag from corner to corner around the part to keep; drag a corner or the inside to change it.",
    icon: '<path d="M7 3v14h14M3 7h14v14"/>',
  },
  hand: {
    label: "Move the view", key: "h", start: () => null,
    hint: "Drag to move the view. With another tool: hold space, the middle button or two fingers.",
    icon: '<path d="M12 3.5v17M3.5 12h17M12 3.5 9.5 6M12 3.5 14.5 6M12 20.5 9.5 18m2.5 2.5 2.5-2.5M3.5 12 6 9.5M3.5 12 6 14.5M20.5 12 18 9.5m2.5 2.5-2.5 2.5"/>',
  },
};
const MODES = {
  walls: ["brush", "line", "rectangle", "outline", "eraser", "clear", "accept", "reject", "hand"],
  trajectory: ["waypoints", "freehand", "hand"],
  measure: ["ruler", "hand"],
  crop: ["frame", "hand"],
};
const DECIDING = new Set(["accept", "reject"]); // only where pieces are doubtful
const toolsOf = (b) => MODES[b.header.mode].filter((name) => b.pieces.length || !DECIDING.has(name));
// Tools on which the straight toggle (or Shift) has an effect.
const ANGLED = new Set(["line", "waypoints", "ruler"]);
const MAX_WIDTH_PX = 60;

const ACTIONS = {
  straight: {
    label: "Straight angles: 0, 45, 90 degrees",
    icon: '<path d="M4 20h16M4 20 15.5 8.5"/><path d="M12 20a8 8 0 0 0-2.3-5.7"/>',
  },
  undo: { label: "Undo (Ctrl+Z)", icon: '<path d="M8.5 5 4.5 9l4 4M5 9h9.5a5 5 0 0 1 0 10H9"/>' },
  redo: { label: "Redo (Ctrl+Shift+Z)", icon: '<path d="m15.5 5 4 4-4 4M19 9H9.5a5 5 0 0 0 0 10H15"/>' },
  remove: {
    label: "Delete all points",
    icon: '<path d="M5 7h14M10 7V4.5h4V7M7 7l1 12.5h8L17 7M10.5 10.5v6m3-6v6"/>',
  },
  "next-piece": { label: "Next doubtful piece (N)", icon: '<path d="M4 12h13m-5-6 6 6-6 6"/>' },
  "accept-all": { label: "Accept all doubtful pieces", icon: '<path d="m2.5 13 4.5 5L15 7m-4.5 9 1.5 2L21.5 7"/>' },
  "reject-all": { label: "Remove all doubtful pieces", icon: '<path d="m3 7 10 10m0-10L3 17m12-10 6 10m0-10-6 10"/>' },
  "zoom-out": { label: "Zoom out (-, or the wheel once the drawing was clicked)", icon: '<circle cx="10.5" cy="10.5" r="6"/><path d="m15 15 5 5M8 10.5h5"/>' },
  fit: { label: "Fit the drawing (0)", icon: '<path d="M4 9V4h5M15 4h5v5M20 15v5h-5M9 20H4v-5"/>' },
  "zoom-in": {
    label: "Zoom in (+, or the wheel once the drawing was clicked)",
    icon: '<circle cx="10.5" cy="10.5" r="6"/><path d="m15 15 5 5M8 10.5h5M10.5 8v5"/>',
  },
};

const svg = (paths) => `<svg viewBox="0 0 24 24" aria-hidden="true">${paths}</svg>`;
