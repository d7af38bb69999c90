// What the theme leaves undone for readers of the book as files, and for those who hear it.

// Opened as files, pages may not read one another: the search lists its finds without the text around them.
if (location.protocol === "file:") DOCUMENTATION_OPTIONS.SHOW_SEARCH_SUMMARY = false;

document.addEventListener("DOMContentLoaded", () => {
  // The book's name above the chapters belongs to a landmark, like them.
  const sidebar = document.querySelector(".bd-sidebar-primary");
  sidebar?.setAttribute("role", "navigation");
  sidebar?.setAttribute("aria-label", "Book");

  // What opens the pages below a chapter is called by that chapter.
  for (const toggle of document.querySelectorAll(".bd-sidebar-primary summary"))
    toggle.setAttribute("aria-label", "Pages of " + (toggle.closest("li")?.querySelector("a")?.textContent.trim() ?? "this part"));

  // A table's head of mathematics alone has no words: it is given them, unseen.
  for (const head of document.querySelectorAll("th")) {
    const math = head.querySelector(".math");
    if (!math || head.textContent.replace(math.textContent, "").trim()) continue;
    const spoken = document.createElement("span");
    spoken.className = "spoken";
    spoken.textContent = math.textContent.replace(/[\\(){}]/g, " ").trim() || "symbol";
    head.append(spoken);
  }

  // A button that shows words is called by them.
  for (const button of document.querySelectorAll("button.search-button-field[aria-label]"))
    button.removeAttribute("aria-label");
});
