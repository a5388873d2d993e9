"use strict";
/* A chapter: one module with one WebGL context draws all of its figures, one after the other, while they are in sight. */
const Book = (() => {
    const TURN = 12; /* seconds of a turn at 30 degrees per second */
    const SETTLE = 400; /* milliseconds before a plot's point follows what is being dragged */
    const FRAMES = 15; /* of which the median time counts */
    const SOON = "100px"; /* from being in sight */
    const DRAWN = "figure.live, figure.formula";
    const {element} = Controls;
    const book = {engine: null, compiled: null, programs: new Map(), figures: [], opened: "", playing: null, last: 0, scheduled: false};

    /* "NAME --option value --flag", or the options alone, as a name and a Map. */
    function read(text, name) {
        const words = text.split(" ").filter(word => word), values = new Map();
        if (words.length && !words[0].startsWith("--"))
            name = words.shift();
        const flags = book.programs.get(name).options.filter(option => option.kind === "flag").map(option => option.name);
        while (words.length) {
            const option = words.shift().slice(2);
            values.set(option, flags.includes(option) ? true : words.shift());
        }
        return {name, values};
    }

    const lines = (name, values) => [name, ...[...values].map(([option, value]) => "--" + option + (value === true ? "" : "=" + value))];

    class Figure {
        constructor(where) {
            this.where = where;
            this.canvas = where.querySelector("canvas");
            this.told = where.querySelector(".told");
            this.base = read(where.dataset.words);
            this.controls = new Map();
            this.wanted = where.dataset.controls.split(",").filter(name => name);
            this.inSight = false;
            this.drawn = "";
            this.set(this.base);
            this.fill();
            this.listen();
        }

        /* Another command; what has the same name keeps its controls. */
        set({name, values}) {
            this.name = name;
            this.values = new Map(values);
            this.seconds = Number(values.get("time") || 0);
            const [a = 0, e = 0, d = 1, r = 0] = (values.get("orbit") || "").split(",").filter(x => x).map(Number);
            this.orbit = [a, e, d, r];
            this.values.delete("time");
            this.values.delete("orbit");
        }

        lines() { return lines(this.name, this.values); }

        /* A button or range of the time, options, a comparison. */
        fill() {
            const form = this.where.querySelector(".controls");
            const {options} = book.programs.get(this.name);
            for (const name of this.wanted) {
                if (name === "time")
                    form.append(this.timeRow());
                else if (name === "error")
                    form.append(this.button("Compare with the exact picture", () => this.compare()));
                else if (name !== "plot")
                    this.controls.set(name, Controls.put(form, options.find(option => option.name === name),
                                                         this.where.id + name, (...changed) => this.change(...changed)));
            }
            form.addEventListener("submit", event => event.preventDefault());
        }

        button(text, action) {
            const made = element("button", {type: "button"}, text);
            made.addEventListener("click", action);
            return made;
        }

        timeRow() {
            this.play = this.button("Play", () => play(book.playing === this ? null : this));
            this.slider = element("input", {type: "range", min: 0, max: TURN, step: 0.05, value: 0,
                                            "aria-label": "Time within a turn, seconds"});
            this.slider.addEventListener("input", () => { this.seconds = Number(this.slider.value); schedule(); });
            return element("div", {class: "row"}, this.play, this.slider);
        }

        change(name, value) {
            const before = new Map(this.values);
            if (value === "" || value === false)
                this.values.delete(name);
            else
                this.values.set(name, value);
            const message = this.open();
            if (message) {
                this.values = before;
                this.open();
            }
            this.told.textContent = message;
            schedule();
        }

        /* The mouse turns the camera, arrows too; a swipe scrolls the page. A click explains the pixel. */
        listen() {
            let from = null;
            point(this.where, this, () => ({texts: new Map(), lines: [...this.lines(), "--time=" + this.seconds,
                                                                      "--orbit=" + this.orbit.join(",")]}));
            const turn = (dx, dy) => {
                const [a, e, ...rest] = this.orbit;
                this.orbit = [(a + dx) % 360, Math.min(90, Math.max(-90, e + dy)), ...rest];
                schedule();
            };
            this.canvas.addEventListener("pointerdown", event => {
                from = {x: event.clientX, y: event.clientY, moved: false};
                if (event.pointerType === "mouse")
                    this.canvas.setPointerCapture(event.pointerId);
            });
            this.canvas.addEventListener("pointermove", event => {
                if (!from || event.pointerType !== "mouse")
                    return;
                const dx = event.clientX - from.x, dy = event.clientY - from.y;
                if (from.moved || Math.hypot(dx, dy) > 3) {
                    turn(-dx / 2, dy / 2);
                    from = {x: event.clientX, y: event.clientY, moved: true};
                }
            });
            this.canvas.addEventListener("pointerup", () => { from = null; });
            this.canvas.addEventListener("keydown", event => {
                const by = {ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, 10], ArrowDown: [0, -10]}[event.key];
                if (!by || event.ctrlKey || event.altKey || event.metaKey)
                    return;
                event.preventDefault();
                event.stopPropagation();
                turn(...by);
            });
        }

        /* "" or why not. */
        open() {
            const lines = this.lines(), key = lines.join("\n");
            if (book.opened !== key && book.engine.run(lines) !== 0) {
                book.opened = "";
                return book.engine.message || "cannot be drawn";
            }
            book.opened = key;
            return "";
        }

        key() { return [this.lines().join("\n"), this.seconds, this.orbit].join("\n"); }

        draw() {
            const message = this.open() || (book.engine.draw(this.seconds, this.orbit) ? "" : book.engine.message || "cannot be drawn");
            this.drawn = this.key();
            if (message) {
                this.told.textContent = message;
                if (!book.figures.some(({picture}) => picture))
                    stand();
                return;
            }
            this.picture = book.engine.picture();
            Controls.paint(this.canvas, this.picture);
            this.canvas.parentNode.classList.remove("loading");
            this.show();
            if (book.playing !== this)
                this.point.renew();
        }

        show() {
            const values = this.name === this.base.name ? book.engine.json("values") : {}, {orbit} = this;
            const turned = orbit[2] === 1 && !orbit[3] ? orbit.slice(0, 2) : orbit;
            for (const [name, control] of this.controls)
                if (!control.inputs.includes(document.activeElement))
                    control.show(this.values.get(name) === true || (values[name] === undefined ? "" : values[name]));
            if (this.slider && document.activeElement !== this.slider)
                this.slider.value = ((this.seconds % TURN) + TURN) % TURN;
            const moved = orbit.some((x, i) => x !== [0, 0, 1, 0][i]);
            const more = (this.seconds ? " --time " + this.seconds : "") + (moved ? " --orbit " + turned.join(",") : "");
            const words = [...this.values].map(([name, value]) => " --" + name + (value === true ? "" : " " + value)).join("");
            this.where.querySelector(".command").textContent = "examples/run " + this.name + words + more;
            if (this.wanted.includes("plot"))
                this.later();
        }

        later() {
            if (this.asked === this.drawn)
                return;
            this.asked = this.drawn;
            clearTimeout(this.timer);
            this.timer = setTimeout(() => this.compare(), SETTLE);
        }

        /* Milliseconds of a frame, drawn and read back. */
        time() {
            const times = [];
            for (let i = 0; i < FRAMES && !this.open(); i++) {
                const start = performance.now();
                book.engine.draw(this.seconds, this.orbit);
                times.push(performance.now() - start);
            }
            return times.sort((a, b) => a - b)[FRAMES >> 1];
        }

        async compare() {
            this.told.textContent = "Computing the exact picture...";
            const milliseconds = this.time();
            const {error, message} = await ErrorWorker.compute({compiled: book.compiled, lines: this.lines(), texts: new Map(),
                                                                seconds: this.seconds, orbit: this.orbit});
            if (!error)
                return message && (this.told.textContent = message);
            const {maximum, rms} = error.inside;
            this.told.textContent = `Error inside objects: at most ${maximum.toFixed(2)} steps of 1/255, root mean square ` +
                `${rms.toFixed(2)}. A frame on this device: ${milliseconds.toFixed(1)} ms, with the copy to the page.`;
            this.move(milliseconds, maximum);
        }

        /* The point of this device in a plot. */
        move(x, y) {
            const plot = this.where.querySelector(".plot");
            if (!plot)
                return;
            const place = (name, value, from, to) => {
                const [low, high] = plot.dataset[name].split(",").map(Number);
                return from + (to - from) * Math.min(1, Math.max(0, (Math.log10(value) - low) / (high - low)));
            };
            const mine = plot.querySelector(".mine"); /* the first: the other is in the key */
            mine.setAttribute("cx", place("x", x, 40, 470));
            mine.setAttribute("cy", place("y", y, 250, 10));
            mine.removeAttribute("visibility");
        }
    }

    /* What explains a pixel of `drawn`, {canvas, picture}, stands above the caption. */
    function point(where, drawn, task) {
        drawn.point = Point.open({canvas: drawn.canvas, line: where.querySelector(".read"), picture: () => drawn.picture, task, late: true,
                                  put: section => where.querySelector("figcaption").before(section)});
    }

    /* Once a frame: what has changed and is in sight. */
    function schedule() {
        if (book.scheduled)
            return;
        book.scheduled = true;
        requestAnimationFrame(now => {
            book.scheduled = false;
            const {playing} = book;
            if (playing && playing.inSight) {
                const passed = Math.round(Math.max(0, now - book.last));
                playing.seconds = Math.round(1000 * playing.seconds + Math.min(250, passed)) / 1000;
                book.last += passed;
                schedule();
            }
            const next = book.figures.find(figure => figure.inSight && figure.drawn !== figure.key());
            if (!next)
                return;
            next.draw();
            schedule();
        });
    }

    function play(figure) {
        for (const other of book.figures)
            if (other.play)
                other.play.textContent = other === figure ? "Pause" : "Play";
        book.playing = figure;
        book.last = performance.now();
        schedule();
    }

    /* An answer sets its options in the figure before it; closed, the figure is as it was. */
    function listenToAnswers() {
        for (const question of document.querySelectorAll(".expect[data-words]")) {
            const before = book.figures.filter(({where}) =>
                where.compareDocumentPosition(question) & Node.DOCUMENT_POSITION_FOLLOWING).pop();
            if (!before)
                continue;
            const {name, values} = read(question.dataset.words, before.base.name);
            const words = name === before.base.name ? new Map([...before.base.values, ...values]) : values;
            question.addEventListener("toggle", () => {
                if (book.printing)
                    return;
                if (!question.open && before.answer !== question)
                    return;
                before.answer = question.open ? question : null;
                before.set(question.open ? {name, values: words} : before.base);
                before.told.textContent = question.open ? "Drawn with the options of the answer that is open." : "";
                schedule();
            });
        }
    }

    /* The module draws into a canvas of its own. When its context is lost, another one takes its place. */
    function newCanvas() {
        const canvas = element("canvas", {width: 1, height: 1});
        canvas.addEventListener("webglcontextlost", event => {
            event.preventDefault();
            setTimeout(() => {
                book.engine.close();
                book.opened = "";
                book.engine.module.canvas = newCanvas();
                book.figures.forEach(figure => { figure.drawn = ""; });
                schedule();
            }, 100);
        });
        return canvas;
    }

    const load = image => { image.src ||= image.dataset.src; };

    /* A still picture comes when it is in sight, and what draws, `begins`, when a figure that is drawn is, as long as all that came since
     * the page is within its budget; the rest as soon as the reader does anything. */
    function watchSight(begins) {
        const {budget, module} = document.body.dataset, waiting = new Set();
        let left = Number(budget), acted = false, called = false;

        function come(target) {
            const still = target.matches("img"), where = target.closest("figure"), weight = Number(still ? target.dataset.weight : called ? 0 : module);
            if (!acted && weight > left) {
                waiting.add(target);
                where.dataset.waits = `${(weight / 1000).toFixed(0)} kB`;
                return;
            }
            left -= weight;
            delete where.dataset.waits;
            watch.unobserve(target);
            if (still)
                load(target);
            else
                draws();
        }

        function draws() {
            called = true;
            begins();
        }

        const watch = new IntersectionObserver(entries => {
            for (const {target, isIntersecting} of entries)
                if (isIntersecting)
                    come(target);
                else if (waiting.delete(target))
                    delete target.closest("figure").dataset.waits;
            if (!called)
                document.body.dataset.ready = "yes";
        }, {rootMargin: SOON});
        document.querySelectorAll("[data-src], " + DRAWN).forEach(target => watch.observe(target));
        function act() {
            acted = true;
            waiting.forEach(come);
            waiting.clear();
            if (document.querySelector(DRAWN))
                draws();
        }
        for (const action of ["scroll", "wheel", "pointermove", "pointerdown", "keydown", "focusin"])
            window.addEventListener(action, act, {once: true, passive: true});
    }

    /* The figures are the pictures that stand there. */
    function stand() {
        document.body.classList.add("still");
        document.querySelectorAll("[data-src]").forEach(image => { image.hidden = false; });
    }

    function listenToPrinting() {
        let closed = [];
        window.addEventListener("beforeprint", () => {
            book.printing = true;
            closed = [...document.querySelectorAll(".expect:not([open])")];
            closed.forEach(question => { question.open = true; });
            document.querySelectorAll("[data-src]").forEach(load);
            document.querySelectorAll(".drawn").forEach(image => { image.loading = "eager"; });
        });
        window.addEventListener("afterprint", () => {
            closed.forEach(question => { question.open = false; });
            setTimeout(() => { book.printing = false; }, 500); /* toggle events come late */
        });
    }

    /* What draws is loaded once. */
    let begun = null;
    const begin = () => begun ||= loadScript("lighting.js").then(() => compileLighting()).then(async compiled => {
        book.compiled = compiled;
        book.engine = await Engine.open(compiled, newCanvas());
        for (const program of book.engine.json("programs"))
            book.programs.set(program.name, program);
    });

    /* The module has drawn something else meanwhile. */
    function renew() {
        book.opened = "";
        schedule();
    }

    async function open() {
        const drawn = [...document.querySelectorAll(DRAWN)];
        listenToPrinting();
        await new Promise(watchSight);
        await begin();
        book.figures = drawn.map(where =>
            where.dataset.slider ? new Formula(where) : new Figure(where));
        const watch = new IntersectionObserver(entries => {
            for (const {target, isIntersecting} of entries)
                book.figures.find(({where}) => where === target).inSight = isIntersecting;
            book.last = performance.now();
            schedule();
        }, {rootMargin: SOON});
        book.figures.forEach(({where}) => watch.observe(where));
        listenToAnswers();
        document.body.dataset.ready = "yes";
    }

    open().catch(error => {
        document.getElementById("error").textContent = "The figures stand still, because this page cannot draw: " + error;
        document.body.dataset.ready = "still";
        stand();
    });
    return {book, schedule, read, lines, point, begin, renew};
})();
