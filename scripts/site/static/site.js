// Shows a picture over the page when its link is followed; without this script the link opens the picture itself.
"use strict";

function enlarge(link) {
  const dialog = document.createElement("dialog");
  dialog.className = "enlarged";
  const button = document.createElement("button");
  button.ariaLabel = "Close";
  const picture = document.createElement("img");
  picture.src = link.href;
  picture.alt = link.querySelector("img").alt;
  button.append(picture);
  button.addEventListener("click", () => dialog.close());
  dialog.append(button);
  dialog.addEventListener("close", () => dialog.remove());
  document.body.append(dialog);
  dialog.showModal();
}

document.addEventListener("click", (event) => {
  const link = event.target.closest("a.picture");
  if (!link || event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  enlarge(link);
});
