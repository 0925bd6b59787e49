// The page's side of the worker: start Python once, and ask it questions.

import { BrokenFile, checkedFile } from "./files.js";

const PATIENCE = 60_000; // milliseconds without any word from a worker that is starting

export class Python {
  // `says` is told {progress, words} while Python starts, and at its end that progress is null.
  constructor(files, says) {
    this.files = files;
    this.says = says;
    this.waiting = new Map();
    this.asked = 0;
  }

  // Start Python, or return the start that is under way. Rejects with what was wrong; then a further
  // call tries again.
  start() {
    this.starting ??= this.load().catch((error) => {
      this.end(error);
      throw error;
    });
    return this.starting;
  }

  async load() {
    for (const name of ["worker.js", "files.js"]) await checkedFile(name, this.files, document.baseURI);
    // A worker that is loaded by its address does not obey this page's policy; one that is made
    // here, of one line, does.
    const line = `import ${JSON.stringify(new URL("worker.js", document.baseURI).href)};`;
    const address = URL.createObjectURL(new Blob([line], { type: "text/javascript" }));
    this.worker = new Worker(address, { type: "module" });
    await new Promise((resolve, reject) => {
      let alarm;
      const wait = () => {
        clearTimeout(alarm);
        alarm = setTimeout(() => reject(new BrokenFile("Python did not start")), PATIENCE);
      };
      const settle = (decide, value) => {
        clearTimeout(alarm);
        decide(value);
      };
      wait();
      this.worker.onerror = (event) => {
        event.preventDefault();
        const error = new BrokenFile(`worker.js failed (${event.message ?? "not loaded"})`);
        settle(reject, error);
        this.end(error);
      };
      this.worker.onmessage = ({ data }) => {
        if (data.progress !== undefined) {
          wait();
          this.says(data);
        } else if (data.ready) {
          this.says({ progress: null, words: "" });
          settle(resolve);
        } else if (data.number === undefined) settle(reject, new BrokenFile(data.failed));
        else this.take(data);
      };
    });
  }

  // Nothing more will come of this worker: refuse what waits for it; the next start makes a new one.
  end(error) {
    for (const { reject } of this.waiting.values()) reject(error);
    this.waiting.clear();
    this.worker?.terminate();
    this.worker = this.starting = undefined;
  }

  take({ number, answer, failed }) {
    const { resolve, reject } = this.waiting.get(number);
    this.waiting.delete(number);
    if (failed === undefined) resolve(JSON.parse(answer));
    else reject(new Error(failed));
  }

  // Ask one question; the answers come in the order of the questions.
  async ask(question) {
    await this.start();
    const number = (this.asked += 1);
    return new Promise((resolve, reject) => {
      this.waiting.set(number, { resolve, reject });
      this.worker.postMessage({ number, question });
    });
  }
}
