"use strict";
/* ?slides: a chapter's headings, figures and formulas one at a time, for a projector. What stands between them are the notes. */
(() => {
    const article = document.querySelector("article");
    const steps = [...article.children].filter(part => part.matches("h1, h2, figure") || part.querySelector("math[display=block]"));
    const scheme = window.matchMedia("(prefers-color-scheme: dark)");
    let at = 0, notes = null;

    /* The paragraphs and questions up to the next step, answers open, as they are but for pictures. */
    function between(page) {
        const parts = [];
        for (let next = steps[at].nextElementSibling; next && !steps.includes(next); next = next.nextElementSibling)
            parts.push(page.importNode(next, true));
        for (const part of parts) {
            part.querySelectorAll("img").forEach(image => image.remove());
            part.open = true;
        }
        return parts;
    }

    function note() {
        if (!notes || notes.closed)
            return;
        const {document: page} = notes;
        page.title = `${at + 1} of ${steps.length}`;
        page.body.style.cssText = "font: 1.3rem/1.5 sans-serif; max-width: 40rem; margin: 1rem auto; padding: 0 1rem";
        page.body.replaceChildren(...between(page));
    }

    function show(step) {
        at = Math.min(steps.length - 1, Math.max(0, step));
        steps.forEach((part, i) => part.classList.toggle("shown", i === at));
        note();
    }

    function press(event) {
        if (event.ctrlKey || event.altKey || event.metaKey || event.target.matches("input, select, textarea"))
            return;
        const root = document.documentElement;
        const keys = {
            PageDown: () => show(at + 1), ArrowRight: () => show(at + 1), PageUp: () => show(at - 1), ArrowLeft: () => show(at - 1),
            Home: () => show(0), End: () => show(steps.length - 1),
            d: () => { root.dataset.scheme = (root.dataset.scheme || (scheme.matches ? "dark" : "light")) === "dark" ? "light" : "dark"; },
            n: () => { notes = window.open("", "notes", "width=700,height=500"); note(); },
            Escape: () => { location.search = ""; },
        };
        if (!keys[event.key])
            return;
        event.preventDefault();
        keys[event.key]();
    }

    if (!/^\?slides\b/.test(location.search))
        return;
    document.body.classList.add("slides");
    document.addEventListener("keydown", press);
    show(0);
})();
