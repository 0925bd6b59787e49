// The entry of the page: check the other files, then make its two parts work.

import { BrokenFile, checkedFile, listOfFiles } from "./files.js";

const state = document.getElementById("state");
const bar = document.getElementById("bar");
const going = document.getElementById("going");

// What begins or has ended, in words: screen readers announce it.
function say(words) {
  state.textContent = words;
  showProgress("", null);
}

// How far it is, in words that are not announced, and from 0 to 1; null when nothing is going on.
function showProgress(words, part) {
  going.textContent = words;
  bar.hidden = part === null;
  if (part !== null) bar.value = part;
}

function sayWrong(error) {
  const safe = "The stored audit below is not touched by this.";
  say(`Not possible here: ${error.message}. ${safe}`);
  state.classList.add("wrong");
}

// Nothing is wrong any more: what was said of it goes.
function clear() {
  if (!state.classList.contains("wrong")) return;
  state.classList.remove("wrong");
  say("");
}

async function begin() {
  say("Checking the files.");
  if (!globalThis.isSecureContext) {
    throw new BrokenFile(
      "files can be checked only on https, or at http://localhost. Put the folder on a host with " +
        "https, or copy it to this machine and run python -m http.server -d FOLDER here",
    );
  }
  const { files } = await listOfFiles(document.baseURI);
  for (const name of ["style.css", "files.js", "python.js", "prove.js", "model.js"]) {
    await checkedFile(name, files, document.baseURI);
  }
  const stored = JSON.parse(
    new TextDecoder().decode(await checkedFile("audit.json", files, document.baseURI)),
  );
  const [{ Python }, { Proofs }, { Model }] = await Promise.all([
    import("./python.js"),
    import("./prove.js"),
    import("./model.js"),
  ]);
  const python = new Python(files, ({ words, progress }) => {
    showProgress(words, progress);
    proofs.showStart(progress);
  });
  const hears = { say, showProgress, sayWrong, clear };
  const proofs = new Proofs(python, stored, hears);
  new Model(python, hears);
  document.body.classList.add("live");
  say("");
}

begin().catch(sayWrong);
