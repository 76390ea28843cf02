// Equations of the pages are drawn by KaTeX; \( \) and \[ \] come from pymdownx.arithmatex.
document.addEventListener("DOMContentLoaded", () =>
    renderMathInElement(document.body, {delimiters: [{left: "\\(", right: "\\)", display: false}, {left: "\\[", right: "\\]", display: true}], throwOnError: false}));
