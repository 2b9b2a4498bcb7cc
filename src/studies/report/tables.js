// Tables that are sorted by the column whose head is pressed, and filtered by what is typed.

function sortTable(table, column, head) {
  const ascending = head.getAttribute("aria-sort") !== "ascending";
  for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
  head.setAttribute("aria-sort", ascending ? "ascending" : "descending");
  const keyOf = (row) => {
    const cell = row.cells[column];
    return cell.dataset.number === undefined ? cell.textContent : Number(cell.dataset.number);
  };
  const compare = (a, b) => {
    if (typeof a === typeof b) return typeof a === "number" ? a - b : a.localeCompare(b);
    return typeof a === "number" ? -1 : 1;
  };
  const rows = [...table.tBodies[0].rows];
  rows.sort((a, b) => compare(keyOf(a), keyOf(b)) * (ascending ? 1 : -1));
  table.tBodies[0].append(...rows);
}

function showTable(section) {
  const table = section.querySelector("table");
  [...table.tHead.rows[0].cells].forEach((head, column) => {
    head.replaceChildren(make("button", { type: "button", click: () => sortTable(table, column, head) },
      head.textContent));
  });
  if (table.tBodies[0].rows.length <= 12) return;
  const filter = make("input", { class: "filter", type: "search", placeholder: "Show rows with …",
    "aria-label": `rows of ${section.querySelector("h2").textContent} with this text`, input: () => {
      for (const row of table.tBodies[0].rows) {
        row.hidden = !row.textContent.toLowerCase().includes(filter.value.toLowerCase());
      }
    } });
  section.querySelector(".scroll").before(filter);
}

/** A button beside the command that copies it; where the browser lets no page do so, it is selected. */
function offerCopy() {
  const command = document.getElementById("command");
  if (!command) return;
  const button = make("button", { type: "button", click: async () => {
    getSelection().selectAllChildren(command);
    try {
      await navigator.clipboard.writeText(command.textContent);
      button.textContent = "Copied";
    } catch {
      button.textContent = "Selected";
    }
  } }, "Copy");
  command.after(button);
}

/** Links to all that follows the evidence. */
function offerContents() {
  const links = make("nav", { "aria-label": "Contents" });
  document.querySelectorAll("main > section").forEach((section, i) => {
    section.id = `part-${i + 1}`;
    links.append(make("a", { href: `#part-${i + 1}` }, section.querySelector("h2").textContent));
  });
  document.querySelector(".cards").after(links);
}

async function showPage() {
  offerCopy();
  document.querySelectorAll("section.table").forEach(showTable);
  document.querySelectorAll("section.chart").forEach((section) => new Chart(section, takeData(section)));
  for (const section of document.querySelectorAll("section.pictures")) await showPictures(section);
  offerContents();
  document.documentElement.dataset.ready = "yes";
}
showPage();
