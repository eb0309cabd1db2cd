// The address line and the button that copies it.

// One listener for the window, even if the element is replaced: the last state counts.
const leaving = (window.occsimLeaving ??= { unsaved: false, isHeard: false });

export default function (component) {
  const { data, parentElement, setStateValue } = component;
  const given = JSON.parse(data);
  const { query, note, unsaved, hasButton, session, projector } = given;
  const root = parentElement.querySelector(".address");
  const said = root.querySelector(".said");
  root.hidden = !hasButton;
  replaceAddress(query);
  heedLeaving(unsaved);
  heedConnection(session);
  heedKeys(projector);
  if (session) keepProgress(given, setStateValue);
  showCurrentPage();
  letWideScroll();
  root.querySelector("button").onclick = () => copy(said, note);
}

// On a telephone the navigation is one row to swipe. Only the row may move: the student
// may have scrolled the page to what the last commit came from.
function showCurrentPage() {
  const row = document.querySelector(".st-key-lessons");
  const current = row?.querySelector(".st-key-current_page");
  if (!current) return;
  const [outer, inner] = [row.getBoundingClientRect(), current.getBoundingClientRect()];
  row.scrollLeft += inner.left + inner.width / 2 - (outer.left + outer.width / 2);
}

// What is wider than a telephone is scrolled by its keys as well.
function letWideScroll() {
  for (const one of document.querySelectorAll("[data-testid=stMarkdownContainer] table, pre")) {
    if (one.scrollWidth > one.clientWidth) one.tabIndex = 0;
  }
}

function replaceAddress(query) {
  const address = new URL(window.location.href);
  address.search = new URLSearchParams(query).toString();
  if (address.href !== window.location.href) {
    // Keep the state that Streamlit's own navigation stores there.
    window.history.replaceState(window.history.state, "", address);
  }
}

// On a projector a digit opens the lesson of that number.
function heedKeys(projector) {
  const { dataset } = document.documentElement;
  dataset.occsimProjector = projector ? "1" : "0";
  if (dataset.occsimKeys) return;
  dataset.occsimKeys = "1";
  document.addEventListener("keydown", (event) => {
    const isOurs = dataset.occsimProjector === "1" && event.target === document.body;
    if (!isOurs || event.ctrlKey || event.metaKey || event.altKey) return;
    const lessons = document.querySelectorAll(".st-key-lesson_keys a");
    if (/^[1-9]$/.test(event.key)) lessons[Number(event.key) - 1]?.click();
  });
}

const PROGRESS = "occsim.progress";
const VOTER = "occsim.voter";

// What was done outlives a reload and the server, and a reload gives no second vote; a
// browser may forbid storage. What this window has not seen, because its session is new or
// another window wrote it, is sent first and comes back with what the session has.
function keepProgress({ progress, cleared, session, voter }, send) {
  if (isNewSession(session)) Object.assign(window, { occsimSession: session, occsimProgress: null });
  window.occsimAwaits = false;
  try {
    const { localStorage } = window;
    if (voter && !localStorage.getItem(VOTER)) localStorage.setItem(VOTER, voter);
    const [kept, votes] = [PROGRESS, VOTER].map((name) => localStorage.getItem(name));
    const isUnseen = kept !== window.occsimProgress;
    window.occsimProgress = kept;
    window.occsimAwaits = isUnseen || (voter !== "" && voter !== votes);
    if (window.occsimAwaits) send("kept", { progress: kept ?? "", voter: votes });
    else if (progress) localStorage.setItem(PROGRESS, (window.occsimProgress = progress));
    else if (cleared) {
      localStorage.removeItem(PROGRESS);
      window.occsimProgress = null;
    }
  } catch {
    // Nothing is kept then.
  }
}

const isNewSession = (session) => window.occsimSession !== session;

function heedLeaving(unsaved) {
  leaving.unsaved = unsaved;
  if (leaving.isHeard) return;
  leaving.isHeard = true;
  window.addEventListener("beforeunload", (event) => {
    if (leaving.unsaved) event.preventDefault();
  });
}

// Streamlit goes on showing what is old when its server is gone.
function heedConnection(session) {
  // Stays while a new session begins: those runs are none of the student's.
  const isBegun = !session || !(isNewSession(session) || window.occsimAwaits);
  if (isBegun) document.querySelector(".occsim-cut")?.remove();
  const app = document.querySelector("[data-testid=stApp]");
  if (!app || app.occsimWatched) return;
  app.occsimWatched = new MutationObserver(() => {
    const state = app.dataset.testConnectionState;
    if (state && state !== "CONNECTED") sayCut();
    else if (document.querySelector(".occsim-cut")) goOn();
  });
  app.occsimWatched.observe(app, { attributeFilter: ["data-test-connection-state"] });
}

function sayCut() {
  if (document.querySelector(".occsim-cut")) return;
  const said = element("div", { class: "occsim-cut", role: "alert" });
  said.style.cssText =
    "position:fixed;inset:auto 0 0 0;z-index:1000;padding:0.75rem 1rem;background:#7a2e00;color:#fff;" +
    "display:flex;gap:1rem;align-items:center;justify-content:center;font:400 1rem sans-serif";
  const button = element("button", { type: "button" }, "Reload");
  button.style.cssText = "min-height:2.5rem;padding:0 1rem";
  button.onclick = () => window.location.reload();
  said.append(
    element(
      "span",
      {},
      "The connection to the server was cut. What you change now is lost. The page goes on when " +
        "the server is back.",
    ),
    button,
  );
  document.body.append(said);
}

// A server that was restarted knows nothing of this page: the first event opens a session,
// by the query that Streamlit's client read when it was loaded, and the move that it
// carries is lost. So the first event is none of the student's, and has today's query.
function goOn() {
  document.querySelector(".occsim-cut span").textContent =
    "The connection to the server was cut and is back. The settings are as they were; the steps " +
    "to undo may be lost, and a building of your own if the server was restarted.";
  window.dispatchEvent(new PopStateEvent("popstate", { state: window.history.state }));
}

async function copy(said, note) {
  const link = window.location.href;
  try {
    await navigator.clipboard.writeText(link);
    said.textContent = `Copied. ${note}`;
  } catch {
    // Without https scripts have no clipboard: copy by selection, else show the link.
    said.textContent = copiedBySelection(link) ? `Copied. ${note}` : link;
  }
}

function copiedBySelection(text) {
  const field = document.createElement("textarea");
  field.value = text;
  field.style.position = "fixed";
  field.style.opacity = "0";
  document.body.append(field);
  field.select();
  const isCopied = document.execCommand("copy");
  field.remove();
  return isCopied;
}
