// Prove the stored audit again: all of it, or one claim, equation or finding from its own card.

const SYMBOLS = { proven: "✓", same: "=", rounded: "≈", differs: "≠" };

const number = (value) => String(Number(value.toPrecision(12)));

export class Proofs {
  constructor(python, stored, hears) {
    this.python = python;
    this.hears = hears;
    this.entries = ["claim", "equation", "finding"].flatMap((kind) =>
      stored[`${kind}s`].map((document) => new Entry(kind, document)),
    );
    this.wanted = new Set(); // entries whose own button was pressed while Python was not ready
    for (const entry of this.entries) entry.addMark(() => this.proveOne(entry));
    this.all = document.getElementById("prove-all");
    this.all.disabled = false;
    this.all.addEventListener("click", () => this.proveAll());
  }

  async proveOne(entry) {
    this.hears.clear();
    this.wanted.add(entry);
    try {
      if (!this.running) this.hears.say(`Proving: ${entry.title}`);
      entry.say("starting Python");
      await this.python.start();
      entry.say("proving");
      await this.prove(entry);
      if (!this.running) this.hears.say(`${entry.title}: ${entry.words}.`);
      entry.button.focus({ preventScroll: true });
    } catch (error) {
      entry.say(`not possible here: ${error.message}`);
      this.hears.sayWrong(error);
    }
    this.wanted.delete(entry);
  }

  // How far the start of Python is, from 0 to 1, in the marks that wait for it; null at its end.
  showStart(part) {
    if (part === null) return;
    const words = `starting Python, ${Math.round(100 * part)} %`;
    for (const entry of this.wanted) entry.say(words);
  }

  async proveAll() {
    if (this.running) return;
    this.running = true;
    this.all.setAttribute("aria-disabled", "true");
    this.hears.clear();
    const counts = { proven: 0, same: 0, rounded: 0, differs: 0 };
    try {
      this.hears.say(`Proving all ${this.entries.length} entries again.`);
      await this.python.start();
      const began = performance.now();
      for (const [k, entry] of this.entries.entries()) {
        const words = `${k + 1} of ${this.entries.length}: ${entry.title}`;
        this.hears.showProgress(words, k / this.entries.length);
        counts[await this.prove(entry)] += 1;
      }
      const seconds = ((performance.now() - began) / 1000).toFixed(1);
      this.hears.say(`${told(counts)} It took ${seconds} s.`);
    } catch (error) {
      this.hears.sayWrong(error);
    }
    this.running = false;
    this.all.removeAttribute("aria-disabled");
  }

  async prove(entry) {
    const { kind, document: stored } = entry;
    const answer = await this.python.ask({ ask: "proof", kind, id: stored.id, stored });
    return entry.mark(answer);
  }
}

function told({ proven, same, rounded, differs }) {
  const parts = [`${proven} proven again here`, `${same} the same again`];
  if (rounded > 0) parts.push(`${rounded} the same but for last digits (${SYMBOLS.rounded})`);
  const end = differs > 0 ? `${differs} NOT as stored (${SYMBOLS.differs})` : "nothing else differs";
  return `${parts.join(", ")}, ${end}.`;
}

// One claim, equation or finding, and its mark on the page.
class Entry {
  constructor(kind, stored) {
    this.kind = kind;
    this.document = stored;
    this.title = stored.title ?? stored.id;
  }

  addMark(prove) {
    const place = document.getElementById(`${this.kind}-${this.document.id}`);
    const isCard = place?.tagName === "ARTICLE";
    this.element = document.createElement(isCard ? "p" : "span");
    this.element.className = "again";
    this.button = document.createElement("button");
    this.button.type = "button";
    this.button.textContent = isCard ? "Prove this again" : "↻";
    this.button.setAttribute("aria-label", `Prove again: ${this.title}`);
    this.button.addEventListener("click", prove);
    this.shown = document.createElement("span");
    this.element.append(this.button, " ", this.shown);
    if (isCard) place.querySelector("h3, p").after(this.element);
    else place?.append(" ", this.element);
    this.isCard = isCard;
  }

  // What goes on, in place of a mark.
  say(words) {
    delete this.element.dataset.outcome;
    this.shown.removeAttribute("title");
    this.shown.textContent = words;
  }

  // Show what came out; returns a key of SYMBOLS.
  mark(answer) {
    const outcome = outcomeOf(answer);
    this.words = wordsOf(outcome, answer);
    this.element.dataset.outcome = outcome;
    const short = document.createElement("span");
    short.textContent = SYMBOLS[outcome];
    short.setAttribute("aria-hidden", "true");
    const words = document.createElement("span");
    words.textContent = ` ${this.words}`;
    if (!this.isCard && answer.differs.length === 0) words.className = "for-readers";
    this.shown.title = this.words;
    this.shown.replaceChildren(short, words);
    return outcome;
  }
}

function outcomeOf({ range, differs }) {
  if (differs.some((difference) => !difference.last_digits)) return "differs";
  if (differs.length > 0) return "rounded";
  return range ? "proven" : "same";
}

// What came out; where something differs, both values, and why that may be.
function wordsOf(outcome, { verdict, computed, range, printed, unit, differs }) {
  if (outcome === "proven") {
    const where = range.includes(" to ") ? `lies from ${range}` : `is ${range}`;
    return (
      `proven again here: the printed ${printed} is ${verdict}. For all inputs that print as ` +
      `the report’s do, the value ${where}`
    );
  }
  const value =
    typeof computed === "number" ? `: ${number(computed)}${unit === "1" ? "" : ` ${unit}`}` : "";
  if (outcome === "same") return `the same again (${verdict}${value})`;
  const both = differs.map(({ where, stored, here }) => `${where}: stored ${stored}, here ${here}`);
  const [what, why] =
    outcome === "rounded"
      ? [
          "the same but for last digits",
          "Here a logarithm or a power is rounded otherwise than where the audit was written.",
        ]
      : [
          "not as stored",
          "The stored audit was changed, or it was made by another version of the program.",
        ];
  return `${what} (${verdict}). ${both.join("; ")}. ${why}`;
}
