"use strict";
/* A formula where it fails: drawn plainly and stably, and the exact picture, with a slider of what breaks it. */
class Formula {
    static queue = Promise.resolve(); /* the worker computes one picture at a time */

    constructor(where) {
        const [option, , , , , value] = where.dataset.slider.split(" ");
        Object.assign(this, {where, option, inSight: false, drawn: "", orbit: [0, 0, 1, 0]});
        const {name, values} = Book.read(where.dataset.words);
        this.told = where.querySelector(".told");
        this.ways = [...where.querySelectorAll(".way")].map(way => ({
            canvas: way.querySelector("canvas"), said: way.lastChild, values: Book.read(way.dataset.words, name).values}));
        this.canvas = this.ways[1].canvas;
        this.slider = where.querySelector("input");
        this.value = number => value.replace("$", number);
        this.base = {name, values: new Map([...values, [option, this.value(this.slider.value)]])};
        this.number = text => text.slice(value.indexOf("$"), text.length - value.length + value.indexOf("$") + 1);
        this.slider.addEventListener("input", () => Book.schedule());
        for (const way of [0, 1])
            Book.point(where, this.ways[way], () => ({lines: this.lines(way), texts: way ? new Map() : this.plain}));
    }

    /* An answer's options: of these, the slider's. */
    set({values}) { this.slider.value = this.number(values.get(this.option)); }

    key() { return this.slider.value; }

    options(way) { return new Map([...this.base.values, [this.option, this.value(this.slider.value)], ...this.ways[way].values]); }

    lines(way) { return [this.base.name, ...[...this.options(way)].map(([name, value]) => `--${name}=${value}`)]; }

    /* The plain formula's files; what they include is the original. */
    texts() {
        const originals = new Map(Book.book.engine.json("shaders").map(({name, text}) => [name, text]));
        return new Map([...this.where.querySelectorAll("[data-file]")].map(part =>
            [part.dataset.file, part.querySelector("pre").textContent.replace(/#include "..\/(.*)"/, (_, name) => originals.get(name))]));
    }

    drawWay(way, texts) {
        const {engine} = Book.book;
        if (!engine.replace(texts) || engine.run(this.lines(way)) !== 0 || !engine.draw(0, this.orbit))
            throw new Error(engine.message);
        const picture = this.ways[way].picture = engine.picture();
        Controls.paint(this.ways[way].canvas, picture);
        this.ways[way].canvas.parentNode.classList.remove("loading");
        this.ways[way].point.renew();
        return picture;
    }

    draw() {
        const {book} = Book;
        this.drawn = this.key();
        try {
            const stable = this.drawWay(1, new Map()), plain = this.drawWay(0, this.plain = this.texts());
            const apart = plain.data.reduce((most, x, i) => Math.max(most, Math.abs(x - stable.data[i])), 0);
            this.ways[0].said.textContent = apart ? `: ${apart} steps from stable` : ": as stable";
            this.show();
        } catch (error) {
            this.told.textContent = error.message;
        }
        book.engine.replace(new Map());
        book.opened = "";
    }

    show() {
        this.where.querySelector(".controls").hidden = false;
        this.where.querySelector("output").textContent = this.value(this.slider.value);
        this.where.querySelector(".command").textContent = ["examples/run", this.base.name,
            ...[...this.options(1)].map(([name, value]) => `--${name} ${value}`)].join(" ");
        clearTimeout(this.timer);
        this.timer = setTimeout(() => { Formula.queue = Formula.queue.then(() => this.compare()); }, 300);
    }

    /* The exact picture, and how far the stable one is from it, unless the slider has gone on. */
    async compare() {
        const {drawn} = this;
        const task = {compiled: Book.book.compiled, lines: this.lines(1), texts: new Map(), seconds: 0, orbit: this.orbit, exact: true};
        const {error, map, message} = drawn === this.key() ? await ErrorWorker.compute(task) : {};
        if (drawn !== this.key() || !error && !message)
            return;
        this.ways[1].said.textContent = error ? `: ${error.inside.maximum.toFixed(1)} steps from exact` : "";
        this.told.textContent = message || "";
        if (map) {
            Controls.paint(this.ways[2].canvas, map);
            this.ways[2].canvas.parentNode.classList.remove("loading");
        }
    }
}
