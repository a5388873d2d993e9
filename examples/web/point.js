"use strict";
/* The pixel that is pointed at, by the mouse, a tap or a cross that the arrow keys move. What explains it (pixel.js, and a
 * module that runs shaders) is loaded when the mouse rests on the picture, or at the first click. */
const Point = (() => {
    const REST = 150; /* ms */
    const part = id => document.getElementById(id);
    const clamp = (x, size) => Math.min(size - 1, Math.max(0, x));
    let of = null, loading = null, timer = 0, start = null, cross = false, at = null;

    function script(name) {
        return new Promise((resolve, reject) => {
            const made = document.createElement("script");
            made.src = name;
            made.onload = resolve;
            made.onerror = () => reject(name + ": is not beside this page");
            document.head.append(made);
        });
    }

    /* In one file all is there. */
    async function load() {
        const there = typeof Pixel !== "undefined";
        const names = there ? [] : part("pixel-line").dataset.scripts.split(" ");
        await (loading ||= names.reduce((before, name) => before.then(() => script(name)), Promise.resolve()));
        Pixel.begin(of);
    }

    const failed = error => { loading = null; say(String(error)); };
    function say(text) { part("pixel-line").textContent = text; }

    /* Column and row. */
    function place(event) {
        const canvas = part("picture"), box = canvas.getBoundingClientRect();
        return [clamp(Math.floor((event.clientX - box.left) / box.width * canvas.width), canvas.width),
                clamp(Math.floor((event.clientY - box.top) / box.height * canvas.height), canvas.height)];
    }

    function tell() {
        const {data, width} = of.picture(), first = 4 * (at[1] * width + at[0]);
        say(at.join(",") + ": " + data.slice(first, first + 3).join(", "));
        if (loading && typeof Pixel !== "undefined")
            Pixel.tell(at);
    }

    function move(to) {
        at = to;
        tell();
    }

    function explain(focus) {
        part("pixel-line").ariaBusy = true;
        return load().then(() => Pixel.explain(at, focus)).catch(failed).finally(() => { part("pixel-line").ariaBusy = null; });
    }

    function setCross(on) {
        cross = on;
        part("pixel-line").ariaLive = on ? "polite" : "off";
        part("picture").classList.toggle("cross", on);
        load().then(() => { Pixel.mark(on ? at : null); tell(); }).catch(failed);
    }

    /* True: the key is the cross's. */
    function press(event) {
        const step = event.shiftKey ? 10 : 1, {width, height} = part("picture");
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
            return false;
        return true;
    }

    /* `of`: {picture(), the last ImageData; task(), what the worker draws; editor(); seen: () => whether the picture rests}. */
    function open(page) {
        of = {...page, say};
        const canvas = part("picture");
        canvas.addEventListener("pointerdown", event => { start = event; });
        canvas.addEventListener("pointermove", event => {
            clearTimeout(timer);
            if (event.buttons || event.pointerType === "touch" || cross)
                return;
            move(place(event));
            timer = setTimeout(() => load().then(tell, failed), loading ? 0 : REST);
        });
        canvas.addEventListener("pointerleave", () => clearTimeout(timer));
        canvas.addEventListener("click", event => {
            if (!start || Math.hypot(event.clientX - start.clientX, event.clientY - start.clientY) > 3)
                return;
            move(place(start)); /* a click's place is rounded */
            explain(false);
        });
    }

    /* Another picture is drawn, and rests. */
    function renew() {
        if (typeof Pixel !== "undefined")
            Pixel.renew();
    }

    return {open, press, renew};
})();
