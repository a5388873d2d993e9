"use strict";
/* The page of one program. */
const Page = (() => {
    const TURN = 12; /* seconds of a turn at 30 degrees per second */
    const SAMPLES = 31; /* of the frame time */
    const LONGEST = 1000; /* letters of a message */
    const {element} = Controls;
    const files = typeof Files === "undefined" ? null : Files;
    const part = id => document.getElementById(id);
    const page = {
        name: document.body.dataset.program,
        engine: null, program: null, compiled: null,
        values: new Map(), /* of options, as the link has them */
        texts: new Map(),  /* of edited shaders */
        seconds: 0, orbit: [0, 0, 1, 0],
        playing: false, last: 0, times: [], picture: null, scheduled: false, controls: null,
    };

    /* Of a link a message may quote much. */
    const fail = message => {
        const text = message.replace(/\/tmp\/shaders\//g, "");
        part("error").textContent = text.length > LONGEST ? text.slice(0, LONGEST) + "..." : text;
    };

    /* What the module is opened with. */
    function lines(values) {
        return [page.name, ...[...values].map(([name, value]) => "--" + name + (value === true ? "" : "=" + value)),
                ...files?.arguments() || []];
    }

    /* What time and camera come to by playing and dragging has few digits, and is drawn as the link and the command have it;
     * what was typed or in a link is drawn with all of its own. */
    const rounded = (x, digits = 1e3) => Math.round(x * digits) / digits || 0;

    /* Time and camera as numbers; they change from frame to frame. */
    function current() {
        const values = new Map(page.values), {seconds, orbit} = page;
        values.delete("time");
        values.delete("orbit");
        if (seconds)
            values.set("time", String(seconds));
        if (orbit[0] || orbit[1] || orbit[2] !== 1 || orbit[3])
            values.set("orbit", orbit.join(","));
        return values;
    }

    /* Opens the program with page.values; "" or why it cannot be. */
    function reopen() {
        return page.engine.run(lines(page.values)) === 0 ? "" : page.engine.message || "cannot be drawn";
    }

    /* Opens and draws with other values, or the same; "", or why not, and then nothing changes: not the link either. */
    function update(next = {}) {
        const {values, seconds, orbit} = page;
        Object.assign(page, next);
        const message = reopen() || takeAngle() || tryDraw();
        page.controls.blame(message);
        fail(message);
        if (message) {
            Object.assign(page, {values, seconds, orbit});
            reopen();
            setLink(page.noted);
            return message;
        }
        const shown = page.engine.json("values");
        for (const option of page.program.options)
            if (option.kind === "flag")
                shown[option.name] = page.values.get(option.name) === true;
        page.controls.show(shown);
        return "";
    }

    /* An angle is a time. */
    function takeAngle() {
        if (page.values.delete("angle"))
            page.seconds = Number(page.engine.json("values").time);
        return "";
    }

    const state = () => ({values: page.values, seconds: page.seconds, orbit: page.orbit});

    function change(name, value) {
        const values = new Map(page.values);
        if (value === "" || value === false)
            values.delete(name);
        else
            values.set(name, value);
        start(values, page.seconds, name === "orbit" && readOrbit(value) || page.orbit, name);
    }

    function readOrbit(text) {
        const numbers = String(text).split(",").map(Number);
        return !text ? [0, 0, 1, 0] : numbers.length < 2 || numbers.some(isNaN) ? null :
            [numbers[0], numbers[1], numbers[2] || 1, numbers[3] || 0];
    }

    function paint(picture) {
        Controls.paint(part("picture"), picture);
        part("picture").parentNode.style.setProperty("--ratio", picture.width / picture.height);
        page.picture = picture;
        Before.draw(now());
    }

    const now = () => ({lines: lines(page.values), edited: page.texts.size > 0, seconds: page.seconds, orbit: page.orbit});

    function tellTime(milliseconds) {
        page.times = [...page.times.slice(1 - SAMPLES), milliseconds];
        const sorted = [...page.times].sort((a, b) => a - b);
        part("frame").textContent = sorted[sorted.length >> 1].toFixed(1) + " ms";
    }

    /* "" or why it cannot be drawn. */
    function tryDraw() {
        const start = performance.now();
        if (!page.engine.draw(page.seconds, page.orbit))
            return page.engine.message || "cannot be drawn";
        paint(page.engine.picture());
        tellTime(performance.now() - start);
        part("command").textContent = page.engine.text("command");
        part("time").value = page.seconds;
        part("slider").value = ((page.seconds % TURN) + TURN) % TURN;
        if (!page.playing)
            note();
        return "";
    }

    function draw() {
        const message = tryDraw();
        if (message) {
            fail(message);
            setPlaying(false);
        }
    }

    /* What is said of a picture at rest, once. */
    function note() {
        const link = Link.join(current(), Lent.lent.packed);
        if (page.noted === link && page.notedTexts === page.texts)
            return;
        page.noted = link;
        page.notedTexts = page.texts;
        if (page.program.scene && !part("exact").hidden) {
            part("exact").hidden = true;
            part("compared").textContent = "The picture has changed since it was compared.";
        }
        ErrorWorker.cancel("The picture has changed; compare again.");
        setLink(link);
        part("whole").hash = link;
        tellAssembled();
        page.point?.renew();
    }

    /* Once a frame, however many events there are. */
    function schedule() {
        if (page.scheduled)
            return;
        page.scheduled = true;
        requestAnimationFrame(now => {
            page.scheduled = false;
            if (page.playing) {
                const passed = Math.round(Math.max(0, now - page.last));
                page.seconds = rounded(page.seconds + Math.min(250, passed) / 1000);
                page.last += passed;
            }
            draw();
            if (page.playing)
                schedule();
        });
    }

    function setPlaying(on) {
        page.playing = on;
        part("play").textContent = on ? "Pause" : "Play";
    }

    function play(on) {
        setPlaying(on);
        page.last = performance.now();
        schedule();
    }

    function setTime(seconds) {
        if (!Number.isFinite(seconds) || Math.abs(seconds) > 1e9)
            return fail("--time " + seconds + ": must be a number, -1 billion to 1 billion");
        page.seconds = seconds;
        fail("");
        schedule();
    }

    function turn(azimuth, elevation, factor, roll = 0) {
        const before = state();
        const limit = (x, min, max) => Math.min(max, Math.max(min, x));
        page.orbit = [rounded((page.orbit[0] + azimuth) % 360), rounded(limit(page.orbit[1] + elevation, -90, 90)),
                      rounded(limit(page.orbit[2] * factor, 0.01, 100), 1e6), rounded((page.orbit[3] + roll) % 360)];
        page.controls.show({...page.engine.json("values"), orbit: page.orbit.join(",")});
        page.undo.remember("the camera", before);
        schedule();
    }

    function reset() {
        const before = state();
        page.orbit = [0, 0, 1, 0];
        page.values = new Map(page.values);
        page.values.delete("orbit");
        turn(0, 0, 1);
        page.undo.remember("the camera's return", before);
    }

    function press(event) {
        const step = event.shiftKey ? 1 : 10;
        const keys = {
            ArrowLeft: () => turn(-step, 0, 1), ArrowRight: () => turn(step, 0, 1),
            ArrowUp: () => turn(0, step, 1), ArrowDown: () => turn(0, -step, 1),
            "[": () => turn(0, 0, 1, step), "]": () => turn(0, 0, 1, -step),
            "+": () => turn(0, 0, 1 / 1.1), "=": () => turn(0, 0, 1 / 1.1), "-": () => turn(0, 0, 1.1),
            " ": () => play(!page.playing), Home: reset,
        };
        if (event.ctrlKey || event.altKey || event.metaKey || !keys[event.key])
            return;
        event.preventDefault();
        keys[event.key]();
    }

    /* One finger or the mouse turns; two fingers or the wheel, once the picture has the focus, go nearer. Before it has the
     * focus a finger scrolls the page up and down. */
    function listenToPointers(canvas) {
        const down = new Map();
        const apart = () => {
            const [a, b] = [...down.values()];
            return Math.hypot(a.x - b.x, a.y - b.y) || 1;
        };
        const scrolls = event => event.pointerType === "touch" && document.activeElement !== canvas;
        canvas.addEventListener("pointerdown", event => {
            canvas.setPointerCapture(event.pointerId);
            down.set(event.pointerId, {x: event.clientX, y: event.clientY});
        });
        canvas.addEventListener("pointermove", event => {
            const before = down.get(event.pointerId), now = {x: event.clientX, y: event.clientY};
            if (!before)
                return;
            const was = down.size === 2 ? apart() : 0;
            down.set(event.pointerId, now);
            if (down.size === 2)
                turn(0, 0, was / apart());
            else if (down.size === 1)
                turn((before.x - now.x) / 2, scrolls(event) ? 0 : (now.y - before.y) / 2, 1);
        });
        for (const name of ["pointerup", "pointercancel"])
            canvas.addEventListener(name, event => down.delete(event.pointerId));
        canvas.addEventListener("wheel", event => {
            if (document.activeElement !== canvas)
                return;
            event.preventDefault();
            turn(0, 0, Math.exp(event.deltaY / 1000));
        }, {passive: false});
    }

    function png() {
        const texts = {Title: page.name, Command: page.engine.text("command"), Software: "lighting, in a browser"};
        return Png.encode(page.picture, page.values.has("alpha"), texts);
    }

    async function save() {
        const blob = await png();
        Controls.save(page.name + ".png", blob);
        return blob;
    }

    /* The options and the texts of the editor. */
    async function wholeLink() {
        return Link.join(current(), await Link.pack(page.editor.changed()));
    }

    const wholeAddress = async () => location.href.replace(/[?#].*/, "") + "#" + await wholeLink();

    function listenToShares(click) {
        click("copy-picture", () => Share.copyPicture(png()));
        click("copy-link", () => Share.copy(page.editor.changed().size ? "the link, which has your shader text" : "the link",
                                            wholeAddress()));
        click("copy-command", () => Share.copy("the command", part("command").textContent));
        click("record", () => Share.record(part("picture"), page.name, play));
        part("record").hidden = !Share.canRecord();
        const own = page.program.options.filter(({name}) => name !== "time");
        Share.embed(own, async chosen => Share.frame(await wholeLink(), chosen, {name: page.name, ...sizeOf(page.picture)}));
    }

    const sizeOf = ({width, height}) => ({width, height});

    async function compare() {
        const show = message => { part("compared").textContent = message; };
        if (page.playing) {
            play(false);
            await new Promise(requestAnimationFrame);
        }
        show("Computing the exact picture...");
        part("compare").setAttribute("aria-busy", true);
        const result = await ErrorWorker.compute({compiled: page.compiled, lines: lines(page.values), texts: page.texts,
                                                  seconds: page.seconds, orbit: page.orbit});
        part("compare").setAttribute("aria-busy", false);
        if (!result.error)
            return result.message && show(result.message);
        const tell = ({pixels, wrong, rms, maximum}) => pixels + " pixels, largest " + maximum.toFixed(2) + ", rms " +
            rms.toFixed(3) + ", " + wrong + " off by more than one step";
        show("In steps of 1/255. Inside objects: " + tell(result.error.inside) + ". All: " + tell(result.error.all) + ".");
        Controls.paint(part("map"), result.map);
        part("exact").hidden = false;
        part("exact-heading").scrollIntoView({block: "nearest"});
        part("exact").scrollIntoView({block: "nearest"});
        return result;
    }

    /* The vertex shader if that has the lights, else the fragment shader. */
    function tellAssembled() {
        if (!part("assembled")?.open)
            return;
        const [vertex = "", fragment = ""] = page.engine.lighting;
        const said = page.engine.explain(true), [text, receipt] = part("assembled").querySelectorAll("pre");
        text.replaceChildren(...Assembled.show(Assembled.read(/^#define VERTEX_LIGHTS/m.test(vertex) ? vertex : fragment), said));
        receipt.textContent = said;
    }

    function tellEffects() {
        if (part("explain").open)
            part("explained").textContent = page.engine.explain();
    }

    function tryOne(text) {
        const known = new Map(page.program.options.map(option => [option.name, option]));
        const words = text.trim().split(/\s+/), values = new Map();
        for (let i = 0; i < words.length; i++) {
            const [, name, value] = words[i].match(/^--([^=]*)(?:=(.*))?$/) || [];
            if (!known.has(name))
                return null;
            values.set(name, known.get(name).kind === "flag" ? true : value !== undefined ? value : words[++i]);
        }
        return values;
    }

    let late = 0;

    /* A browser that refuses, because there were too many, is asked again. */
    function setLink(link = "") {
        const before = location.hash;
        clearTimeout(late);
        try {
            history.replaceState(null, "", "#" + link);
        } catch { /* it is as before */ }
        if (location.hash === before && before.slice(1) !== link)
            late = setTimeout(() => setLink(page.noted), 1000);
    }

    function start(values, seconds = Number(values.get("time") || 0),
                   orbit = readOrbit(values.get("orbit")) || [0, 0, 1, 0], kind = Undo.ALL) {
        const before = state(), message = update({values, seconds, orbit});
        if (!message)
            page.undo.remember(kind, before);
        return message;
    }

    function listTries() {
        for (const {arguments: text, looks} of page.program.tries) {
            const values = tryOne(text);
            if (!values)
                continue;
            const button = element("button", {type: "button"}, text);
            button.addEventListener("click", () => start(values));
            part("tries").append(element("li", {}, button, " ", looks));
        }
        part("tries").closest("section").hidden = !part("tries").childElementCount;
    }

    /* The module draws into a canvas of its own. When its context is lost, another one takes its place. */
    function newCanvas() {
        const canvas = document.createElement("canvas");
        canvas.width = canvas.height = 1;
        canvas.addEventListener("webglcontextlost", event => {
            event.preventDefault();
            part("status").textContent = "The graphics context was lost; drawing again.";
            setTimeout(() => recover(10), 0);
        });
        return canvas;
    }

    function recover(attempts) {
        page.engine.close();
        page.engine.module.canvas = newCanvas();
        const message = update();
        if (!message)
            part("status").textContent = "Drawn again after the graphics context was lost.";
        else if (attempts > 1)
            setTimeout(() => recover(attempts - 1), 1000);
    }

    /* What the program has natively only, models among it. */
    function listAbsent() {
        const {absent} = page.program;
        const models = absent.includes("model");
        part("absent").textContent = absent.length ? " Of this program's own options: --" + absent.join(", --") + "." : "";
        if (!files)
            Controls.refuseFiles(name => fail(name + ": this page reads no files" + (models ?
                ": the page beside others reads models, in one file it is without" : "; Scene.html reads models and scenes")));
    }

    /* What was read is drawn by the module that read it, with options, texts and camera as they are. */
    async function takeFiles(compiled) {
        const engine = await Engine.open(compiled, newCanvas());
        engine.replace(page.texts);
        if (engine.run(lines(page.engine ? page.values : new Map())) !== 0)
            throw engine.message;
        if (!page.engine)
            return begin(compiled, engine);
        page.engine.close();
        page.compiled = compiled;
        page.engine = engine;
        Before.forget(compiled, now);
        page.noted = null;
        fillControls();
        page.undo.clear();
        const message = update();
        if (message)
            throw message;
        tellEffects();
    }

    function fillControls() {
        const hidden = files ? [files.option] : [];
        page.program = page.engine.json("programs").find(({name}) => name === page.name);
        part("options").replaceChildren();
        page.controls = Controls.fill(part("options"), page.program.options.filter(each => shows(each) && !hidden.includes(each.name)), change);
        for (const folded of part("options").querySelectorAll("details"))
            folded.open = Boolean(embedded);
    }

    function listen() {
        const click = (id, action) => part(id).addEventListener("click", action);
        const canvas = part("picture");
        canvas.addEventListener("keydown", press);
        listenToPointers(canvas);
        if (!embedded)
            page.point = Point.open({canvas, line: part("pixel-line"), picture: () => page.picture, module: () => files?.module(), editor: () => page.editor,
                                     task: () => ({lines: lines(current()), texts: page.texts}),
                                     put: section => document.querySelector("main > :last-child").prepend(section)});
        click("play", () => play(!page.playing));
        click("back", () => setTime(rounded(page.seconds - 0.1)));
        click("forward", () => setTime(rounded(page.seconds + 0.1)));
        click("reset", reset);
        click("save", save);
        click("default", () => start(new Map()));
        click("undo", page.undo.undo);
        click("redo", page.undo.redo);
        click("wipe-on", () => Before.toggle(page.compiled, now));
        part("slider").addEventListener("input", event => setTime(Number(event.target.value)));
        part("time").addEventListener("change", event => setTime(Number(event.target.value)));
        part("options").addEventListener("submit", event => event.preventDefault());
        window.addEventListener("hashchange", () => {
            follow();
            Lent.show();
        });
        listenToShares(click);
        if (page.program.scene) {
            click("compare", compare);
            part("explain").addEventListener("toggle", tellEffects);
            part("assembled").addEventListener("toggle", tellAssembled);
        }
    }

    /* A link's options; if they are wrong the picture and the link are those without them. */
    function follow() {
        let message;
        Lent.lent.packed = Link.packed(location.hash);
        try {
            message = start(Link.read(location.hash));
        } catch (error) {
            message = String(error);
            setLink(page.noted);
        }
        if (message && !page.picture)
            start(new Map());
        if (message)
            fail(message);
    }

    function replace(texts) {
        if (!page.engine.replace(texts))
            return page.engine.message;
        page.texts = texts;
        const message = reopen() || tryDraw();
        part("old").hidden = !message;
        if (message) {
            page.engine.replace(page.drawn);
            page.texts = page.drawn;
            reopen();
            return message.replace(/\/tmp\/shaders\//g, "");
        }
        page.drawn = texts;
        Lent.drawn();
        return page.engine.message.replace(/\/tmp\/shaders\//g, "");
    }

    /* The names of the controls that a part of another page shows: ?embed=material,shininess; null: the page is whole. */
    const embedded = new URLSearchParams(location.search).get("embed")?.split(",") || null;
    const shows = ({name}) => !embedded || embedded.includes(name);

    /* The one with the lights first: of a lecture's pair the longer one. */
    function shaders() {
        const files = page.engine.json("shaders");
        return page.program.scene ? files : files.sort((a, b) => b.text.length - a.text.length);
    }

    async function begin(compiled, engine) {
        const start = performance.now();
        page.drawn = new Map();
        page.compiled = compiled;
        page.engine = engine;
        document.body.classList.remove("waits");
        fillControls();
        page.undo = Undo.open(state, update, message => { part("status").textContent = message; });
        listTries();
        listAbsent();
        listen();
        part("embed").hidden = files?.option === "file"; /* it would have no file */
        follow();
        if (!page.picture)
            return;
        part("status").textContent = embedded ? "" : "First picture after " + (performance.now() - (page.begun || start)).toFixed(0) + " ms.";
        page.editor = Editor.open(part("editor"), "lighting " + page.name, shaders(), replace);
        await Lent.open(page.editor, {note, fail, draw: replace});
        page.undo.clear();
        document.body.dataset.ready = "yes";
        if (/[?&]as=/.test(location.search))
            page.point?.show();
    }

    /* Scene's page has nothing to draw before a file is chosen. */
    async function open() {
        const meant = Link.embedding(location);
        if (meant)
            return location.replace(meant);
        document.body.classList.toggle("embed", Boolean(embedded));
        files?.listen(takeFiles, fail);
        page.begun = performance.now();
        if (files?.option === "file") {
            page.begun = 0;
            document.body.classList.add("waits");
            part("status").textContent = "Choose a scene, or drop it on the page.";
            document.body.dataset.ready = "yes";
            return;
        }
        const compiled = await compileLighting();
        await begin(compiled, await Engine.open(compiled, newCanvas()));
    }

    open().catch(error => {
        part("status").textContent = "";
        fail("This page cannot run: " + error);
    });
    return {page, save, compare, update, lines, start, play};
})();
