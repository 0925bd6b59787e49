// The entry of the page: check the other files, then make its two parts work.

import { BrokenFile, checkedFile, listOfFiles } from "./files.js";

const state = document.getElementById("state");
const bar = document.getElementById("bar");

// What is going on, in words; `progress` from 0 to 1, or null when nothing is going on.
function say(words, progress = null) {
  state.textContent = words;
  bar.hidden = progress === null;
  if (progress !== null) bar.value = progress;
}

function sayWrong(error) {
  const safe = "The stored audit below is not touched by this.";
  say(`Not possible here: ${error.message}. ${safe}`);
  state.classList.add("wrong");
}

async function begin() {
  if (!globalThis.isSecureContext) {
    throw new BrokenFile("files can be checked only on https or on this machine's own localhost");
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
  const python = new Python(files, ({ words, progress }) => say(words, progress));
  const hears = { say, sayWrong, clear: () => state.classList.remove("wrong") };
  new Proofs(python, stored, hears);
  new Model(python, hears);
  document.body.classList.add("live");
  say("");
}

begin().catch(sayWrong);
