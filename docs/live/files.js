// Fetch files of this folder, and use none that is not as it was built.

export class BrokenFile extends Error {}

// The list of all files with their sizes and hashes, which build.py writes.
export async function listOfFiles(base) {
  const response = await fetched("files.json", base);
  try {
    return await response.json();
  } catch {
    throw new BrokenFile("files.json is damaged: build the folder again, or copy it anew");
  }
}

// The bytes of a file. Throws BrokenFile, which names the file, if it is absent or was changed.
export async function checkedFile(name, files, base, arrived = () => {}) {
  if (!(name in files)) throw new BrokenFile(`${name} is not in files.json: build the folder again`);
  const response = await fetched(name, base);
  const bytes = await read(name, response, arrived);
  const digest = new Uint8Array(await crypto.subtle.digest("SHA-256", bytes));
  const hexadecimal = Array.from(digest, (byte) => byte.toString(16).padStart(2, "0")).join("");
  if (hexadecimal !== files[name].sha256) {
    const size = `${bytes.length} bytes of ${files[name].bytes}`;
    throw new BrokenFile(`${name} is not the file that was built (${size}): copy it anew`);
  }
  return bytes;
}

async function fetched(name, base) {
  let response;
  try {
    response = await fetch(new URL(name, base));
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
