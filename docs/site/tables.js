// Tables of class "sortable": sorted by a click on a head, searched, and filtered by menus over the
// columns that data-menus names. DataTables does the work; this file only says where.
(() => {
  const PAGE = 25;

  // DataTables takes its dark look from a class of the page.
  const followTheme = () => {
    const root = document.documentElement;
    root.classList.toggle("dark", root.dataset.theme === "dark");
  };

  // A menu of the words of a column, which shows the rows that begin with the chosen one.
  const menu = (api, index) => {
    const column = api.column(index);
    const title = column.header().textContent.trim();
    const words = new Set();
    column.nodes().each((cell) => words.add(cell.textContent.trim().replace(/ \*$/, "")));
    const select = document.createElement("select");
    select.setAttribute("aria-label", `filter by ${title}`);
    select.className = "form-select form-select-sm";
    select.dataset.column = title;
    select.add(new Option(`${title}: all`, ""));
    for (const word of [...words].sort()) select.add(new Option(word, word));
    select.addEventListener("change", () => {
      const chosen = select.value.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
      column.search(chosen ? `^${chosen}( \\*)?$` : "", { regex: true, smart: false }).draw();
    });
    return select;
  };

  const start = (table) => {
    const $ = window.jQuery;
    const rows = table.tBodies[0].rows.length;
    const api = $(table).DataTable({
      order: [],
      paging: rows > PAGE,
      pageLength: PAGE,
      lengthMenu: [10, PAGE, 50, 100, { label: "all", value: -1 }],
      searching: true,
      info: rows > PAGE,
      autoWidth: false,
      layout: {
        topStart: rows > PAGE ? "pageLength" : null,
        topEnd: rows > 5 ? "search" : null,
      },
      language: { search: "", searchPlaceholder: "search this table" },
    });
    if (table.dataset.menus) {
      const bar = document.createElement("div");
      bar.className = "table-menus";
      for (const index of table.dataset.menus.split(",")) bar.append(menu(api, Number(index)));
      table.closest(".wide").before(bar);
    }
  };

  // A card that a link leads to opens what it hides.
  const openTarget = () => {
    const id = decodeURIComponent(window.location.hash.slice(1));
    const target = id && document.getElementById(id);
    const hidden = target && target.closest("details");
    if (hidden) hidden.open = true;
  };

  document.addEventListener("DOMContentLoaded", () => {
    followTheme();
    new MutationObserver(followTheme).observe(document.documentElement, {
      attributeFilter: ["data-theme"],
    });
    document.querySelectorAll("table.sortable").forEach(start);
    openTarget();
    window.addEventListener("hashchange", openTarget);
  });
})();
