// Python in a worker: load it from checked files, then answer one question after another.
//
// Messages to the page: {progress, words} while loading, {ready}, {failed}, {number, answer} and
// {number, failed}. Messages from the page: {number, question}.

import { checkedFile, listOfFiles } from "./files.js";

const BASE = new URL("./", import.meta.url);
const EMPTY_MODULE = new Uint8Array([0, 0x61, 0x73, 0x6d, 1, 0, 0, 0]);

// Fetch and check every file before anything is started: Pyodide waits for ever for a damaged one.
async function checkedFiles() {
  const { files, loads, lock } = await listOfFiles(BASE);
  const total = loads.reduce((sum, name) => sum + files[name].bytes, 0);
  const megabytes = (bytes) => (bytes / 1e6).toFixed(1);
  let sum = 0;
  const arrived = (bytes) => {
    sum += bytes;
    const words = `Loading Python: ${megabytes(sum)} of ${megabytes(total)} MB`;
    postMessage({ progress: (0.7 * sum) / total, words });
  };
  const contents = new Map();
  await Promise.all(
    loads.map(async (name) => contents.set(name, await checkedFile(name, files, BASE, arrived))),
  );
  return { contents, lock };
}

// Pyodide fetches its files by address. It gets the bytes that were checked, and nothing else.
function giveOnly(contents) {
  self.fetch = async (address) => {
    const name = String(address?.url ?? address).replace(BASE.href, "");
    if (!contents.has(name)) throw new Error(`${name} is not a file of this page`);
    const type = name.endsWith(".wasm") ? "application/wasm" : "application/octet-stream";
    return new Response(contents.get(name), { headers: { "Content-Type": type } });
  };
}

async function start() {
  const { contents, lock } = await checkedFiles();
  postMessage({ progress: 0.72, words: "Starting Python" });
  await WebAssembly.compile(EMPTY_MODULE); // says here, and not never, that WebAssembly is forbidden
  giveOnly(contents);
  const { loadPyodide } = await import(new URL("pyodide.mjs", BASE));
  const python = await loadPyodide({
    indexURL: BASE.href,
    packageBaseUrl: BASE.href,
    lockFileContents: lock,
  });
  postMessage({ progress: 0.85, words: "Starting Python: libraries" });
  for (const [name, bytes] of contents) {
    if (name.endsWith(".whl")) python.unpackArchive(bytes, "wheel");
  }
  python.FS.writeFile("answers.py", contents.get("answers.py"));
  python.runPython("import sys; sys.path.insert(0, '.')");
  postMessage({ progress: 0.9, words: "Starting Python: the report" });
  return python.pyimport("answers").answer;
}

const started = start();
started.then(
  () => postMessage({ ready: true }),
  (error) => postMessage({ failed: lastLine(error) }),
);

onmessage = async ({ data: { number, question } }) => {
  try {
    const answer = await started;
    postMessage({ number, answer: answer(JSON.stringify(question)) });
  } catch (error) {
    postMessage({ number, failed: lastLine(error) });
  }
};

// The last line of a Python traceback says what was wrong.
function lastLine(error) {
  return String(error.message ?? error).trim().split("\n").at(-1);
}
