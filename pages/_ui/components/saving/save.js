// The menu of what can be saved, and the saving itself.

// Items are {label, about, save}: save(tell) resolves to {blob, name}, or to null where
// it was stopped; tell says how far it is. One item is saved at a time.
function saveMenu(items) {
  const said = element("p", { role: "status" });
  const menu = element("details", { class: "save" }, element("summary", {}, "Save"));
  const buttons = items.map(({ label, about, save }) => {
    const button = element("button", { type: "button" }, label);
    if (about) button.append(element("small", {}, about));
    button.addEventListener("click", () => saveItem(buttons, said, save));
    return button;
  });
  menu.append(element("div", { class: "save-menu", role: "group", "aria-label": "Save" }, ...buttons, said));
  menu.addEventListener("toggle", () => setText(said, ""));
  menu.addEventListener("keydown", (event) => {
    if (event.key === "Escape") closeMenu(menu);
    // The keys of a menu are not those of what it belongs to.
    event.stopPropagation();
  });
  return menu;
}

function closeMenu(menu) {
  menu.open = false;
  menu.firstElementChild.focus();
}

// Buttons that wait keep the focus, so that Escape still closes the menu.
async function saveItem(buttons, said, save) {
  const isBusy = buttons[0].ariaDisabled === "true";
  if (isBusy) return;
  for (const button of buttons) button.ariaDisabled = "true";
  try {
    const saved = await save((words) => setText(said, words));
    if (saved) download(saved.blob, saved.name);
    setText(said, saved ? `Saved ${saved.name}, ${sizeWords(saved.blob.size)}.` : "Stopped.");
  } catch {
    setText(said, "This browser could not save it.");
  } finally {
    for (const button of buttons) button.ariaDisabled = "false";
  }
}

const sizeWords = (bytes) =>
  bytes < 1e6 ? `${Math.ceil(bytes / 1000)} kB` : `${(bytes / 1e6).toFixed(1)} MB`;

function download(blob, name) {
  const link = element("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 60000); // a slow disk may still read it
}

const pageTitle = () => document.title.split(" \u00b7 ")[0];

const fileStem = () => `occsim_${pageTitle().toLowerCase().match(/\w+/g).join("_")}`;
