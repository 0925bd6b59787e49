// Fetch files of this folder, and use none that is not as it was built.

export class BrokenFile extends Error {}

const PATIENCE = 20_000; // milliseconds without a byte: the server has stalled

// The files that are being loaded have one alarm: a browser asks for few at a time, so that some
// wait for others on a slow line, and nothing is wrong with them.
const loading = new Set();
let alarm;

// The list of all files with their sizes and hashes, which build.py writes.
export async function listOfFiles(base) {
  const bytes = await loaded("files.json", base);
  try {
    return JSON.parse(new TextDecoder().decode(bytes));
  } catch {
    throw new BrokenFile("files.json is damaged: build the folder again, or copy it anew");
  }
}

// The bytes of a file. Throws BrokenFile, which names the file, if it is absent or was changed.
export async function checkedFile(name, files, base, arrived = () => {}) {
  if (!(name in files)) throw new BrokenFile(`${name} is not in files.json: build the folder again`);
  const bytes = await loaded(name, base, arrived);
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  const hexadecimal = Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("");
  if (hexadecimal !== files[name].sha256) {
    const size = `${bytes.length} bytes of ${files[name].bytes}`;
    throw new BrokenFile(`${name} is not the file that was built (${size}): copy it anew`);
  }
  return bytes;
}

async function loaded(name, base, arrived = () => {}) {
  const controller = new AbortController();
  loading.add(controller);
  setAlarm();
  try {
    const response = await fetched(name, base, controller.signal);
    return await read(name, response, arrived);
  } finally {
    loading.delete(controller);
    setAlarm();
  }
}

// Give up what is being loaded after PATIENCE from now, unless this is called again before.
function setAlarm() {
  clearTimeout(alarm);
  if (loading.size === 0) return;
  alarm = setTimeout(() => {
    const stalled = new Error(`the server sent nothing for ${PATIENCE / 1000} s`);
    for (const controller of loading) controller.abort(stalled);
  }, PATIENCE);
}

async function fetched(name, base, signal) {
  let response;
  try {
    response = await fetch(new URL(name, base), { signal });
  } catch (error) {
    throw new BrokenFile(`${name} cannot be loaded (${error.message})`);
  }
  if (!response.ok) throw new BrokenFile(`${name} is absent (the server says ${response.status})`);
  return response;
}

async function read(name, response, arrived) {
  const pieces = [];
  let length = 0;
  try {
    for (const reader = response.body.getReader(); ; ) {
      const { done, value } = await reader.read();
      if (done) break;
      pieces.push(value);
      length += value.length;
      arrived(value.length);
      setAlarm();
    }
  } catch (error) {
    throw new BrokenFile(`${name} broke off after ${length} bytes (${error.message})`);
  }
  const bytes = new Uint8Array(length);
  let at = 0;
  for (const piece of pieces) {
    bytes.set(piece, at);
    at += piece.length;
  }
  return bytes;
}
