"use strict";
/* The picture as it was, drawn beside the page's own by a module of its own: by the original texts where they are edited, else
 * with the options of when it was switched on. Time and camera are those of now. */
const Before = (() => {
    const part = id => document.getElementById(id);
    let engine = null, kept = null, opened = null, on = false;

    /* `now`: {lines, edited, seconds, orbit}. */
    function draw(now) {
        if (!on || !engine)
            return;
        const lines = now.edited ? now.lines : kept.lines, text = lines.join("\n");
        part("wipe-said").textContent = now.edited ? "Left: by the original text. Right: by yours." :
            "Left: with the options of when you switched this on. Right: as it is now.";
        if (text !== opened && engine.run(lines) !== 0 || !engine.draw(now.seconds, now.orbit)) {
            opened = null;
            part("wipe-said").textContent = "The picture as it was cannot be drawn: " + engine.message;
            return;
        }
        opened = text;
        Controls.paint(part("before"), engine.picture());
    }

    /* `now()` is as above. */
    async function toggle(compiled, now) {
        on = !on;
        part("wipe-on").setAttribute("aria-pressed", on);
        part("before").hidden = part("wipe-row").hidden = !on;
        if (!on)
            return;
        kept = now();
        if (!engine) {
            const canvas = document.createElement("canvas");
            canvas.width = canvas.height = 1;
            engine = await Engine.open(compiled, canvas);
            canvas.addEventListener("webglcontextlost", () => { engine = null; opened = null; });
            part("wipe").addEventListener("input", () => Wipe.show(part("wipe"), part("before")));
        }
        Wipe.show(part("wipe"), part("before"));
        draw(now());
    }

    /* The module that draws is another one. */
    function forget(compiled, now) {
        engine = opened = null;
        if (on)
            toggle(compiled, now);
    }

    return {draw, toggle, forget};
})();
