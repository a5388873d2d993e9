"use strict";
/* The pixel of a picture that is pointed at, by the mouse, a tap or a cross that the arrow keys move. What explains it (pixel.js, and
 * a module that runs shaders) is loaded when the mouse rests on the picture, or at the first click. */
const Point = (() => {
    const REST = 150; /* ms */
    const clamp = (x, size) => Math.min(size - 1, Math.max(0, x));
    let loading = null;

    /* In one file all is there. */
    function load() {
        const there = name => typeof Pixel !== "undefined" || [...document.scripts].some(({src}) => src.endsWith("/" + name));
        const names = document.body.dataset.pointed.split(" ").filter(name => !there(name));
        return loading ||= names.reduce((before, name) => before.then(() => loadScript(name)), Promise.resolve());
    }

    /* `of`: {canvas; line, which says what is there; picture(), the last ImageData; task(), what the worker draws; editor(), or none;
     * put(section) shows what explains, from now on; late: what explains is loaded at a click only}. */
    function open(of) {
        const {canvas, line} = of;
        let timer = 0, start = null, cross = false, at = null;
        const say = of.say = text => { line.textContent = text; };
        const failed = error => { loading = null; say(String(error)); };
        const begin = () => load().then(() => Pixel.begin(of));

        /* Column and row. */
        function place(event) {
            const box = canvas.getBoundingClientRect();
            return [clamp(Math.floor((event.clientX - box.left) / box.width * canvas.width), canvas.width),
                    clamp(Math.floor((event.clientY - box.top) / box.height * canvas.height), canvas.height)];
        }

        function tell() {
            const {data, width} = of.picture(), first = 4 * (at[1] * width + at[0]);
            say(at.join(",") + ": " + data.slice(first, first + 3).join(", "));
            if (loading && typeof Pixel !== "undefined")
                Pixel.tell(of, at);
        }

        function move(to) {
            at = to;
            tell();
        }

        function explain(focus) {
            line.ariaBusy = true;
            return begin().then(() => Pixel.explain(at, focus)).catch(failed).finally(() => { line.ariaBusy = null; });
        }

        function setCross(on) {
            cross = on;
            line.ariaLive = on ? "polite" : "off";
            canvas.classList.toggle("cross", on);
            begin().then(() => { Pixel.mark(on ? at : null); tell(); }).catch(failed);
        }

        /* A key that is the cross's is nobody else's. */
        function press(event) {
            const step = event.shiftKey ? 10 : 1, {width, height} = canvas;
            const by = {ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step]}[event.key];
            if (event.key === "Enter" && !cross) {
                at ||= [width >> 1, height >> 1];
                setCross(true);
                tell();
            } else if (event.key === "Enter")
                explain(true);
            else if (cross && event.key === "Escape")
                setCross(false);
            else if (cross && by) {
                move([clamp(at[0] + by[0], width), clamp(at[1] + by[1], height)]);
                if (typeof Pixel !== "undefined")
                    Pixel.mark(at);
            } else
                return;
            event.preventDefault();
            event.stopImmediatePropagation();
        }

        canvas.addEventListener("keydown", press, true);
        canvas.addEventListener("pointerdown", event => { start = event; });
        canvas.addEventListener("pointermove", event => {
            clearTimeout(timer);
            if (event.buttons || event.pointerType === "touch" || cross || !of.picture())
                return;
            move(place(event));
            if (!of.late || loading)
                timer = setTimeout(() => load().then(tell).catch(failed), loading ? 0 : REST);
        });
        canvas.addEventListener("pointerleave", () => clearTimeout(timer));
        canvas.addEventListener("click", event => {
            if (!start || !of.picture() || Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY) > 3)
                return;
            move(place(start)); /* a click's place is rounded */
            explain(false);
        });

        /* renew: another picture is drawn, and rests. show: of the pixel in the middle. */
        return {show: () => { at ||= [canvas.width >> 1, canvas.height >> 1]; return explain(false); }, renew: () => typeof Pixel !== "undefined" && Pixel.renew(of)};
    }

    return {open, load};
})();
