// The address line and the button that copies it.

// One listener for the window, even if the element is replaced: the last state counts.
const leaving = (window.occsimLeaving ??= { unsaved: false, isHeard: false });

export default function (component) {
  const { data, parentElement } = component;
  const { query, note, unsaved, hasButton } = JSON.parse(data);
  const root = parentElement.querySelector(".address");
  const said = root.querySelector(".said");
  root.hidden = !hasButton;
  replaceAddress(query);
  heedLeaving(unsaved);
  root.querySelector("button").onclick = () => copy(said, note);
}

function replaceAddress(query) {
  const address = new URL(window.location.href);
  address.search = new URLSearchParams(query).toString();
  if (address.href !== window.location.href) {
    // Keep the state that Streamlit's own navigation stores there.
    window.history.replaceState(window.history.state, "", address);
  }
}

function heedLeaving(unsaved) {
  leaving.unsaved = unsaved;
  if (leaving.isHeard) return;
  leaving.isHeard = true;
  window.addEventListener("beforeunload", (event) => {
    if (leaving.unsaved) event.preventDefault();
  });
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
