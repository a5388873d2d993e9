"use strict";
/* The page of one lab. */
const Lab = (() => {
    const WAIT = 200; /* ms after the time's last change until the exact picture */
    const {element} = Controls;
    const part = id => document.getElementById(id);
    const lab = {name: document.body.dataset.lab, path: document.body.dataset.lab, own: null, files: [], texts: new Map(), seconds: 1, editor: null};
    const short = message => message.replace(/\/tmp\/mine\//g, "");
    /* Set while a text is drawn: if it is there when the page opens, that text may have hung the page. */
    const RUNNING = "lighting drawing " + lab.name;

    function mark(on) {
        try {
            if (on)
                localStorage.setItem(RUNNING, "yes");
            else
                localStorage.removeItem(RUNNING);
        } catch { /* nothing is kept, nothing is drawn again */ }
    }

    function isMarked() {
        try {
            return localStorage.getItem(RUNNING) !== null;
        } catch {
            return false;
        }
    }

    async function ask(task) {
        mark(true);
        const answer = await LabWorker.ask({lab: lab.path, own: lab.own, texts: lab.texts, ...task});
        if (answer)
            mark(false);
        return answer;
    }

    /* null: something else is drawn instead; else a message, "" if it is drawn. */
    async function draw(exact) {
        const answer = await ask({what: "draw", seconds: lab.seconds, exact});
        if (!answer)
            return null;
        part("error").textContent = "";
        if (answer.message)
            return short(answer.message);
        for (const id of ["drawn", "expected", "difference"])
            if (answer[id])
                Controls.paint(part(id), answer[id]);
        if (exact)
            lab.pictures = [answer.drawn, answer.expected, answer.difference];
        lab.picture = answer.drawn;
        lab.shown = lab.texts;
        if (exact)
            lab.point?.renew();
        part("compared").textContent = !exact ? "" : answer.largest < 0 ? "" :
            "Largest difference inside objects: " + answer.largest.toFixed(2) + " steps of 1/255.";
        return "";
    }

    async function apply(texts) {
        lab.texts = texts;
        const first = await draw(false); /* what is expected takes longer */
        const message = first === "" ? await draw(true) : first;
        if (message !== null)
            part("old").hidden = !message;
        return message === "" && texts.size && !part("check") ? "Kept; the browser compiles no C." : message;
    }

    let timer = 0;

    async function setTime(seconds) {
        if (!Number.isFinite(seconds) || Math.abs(seconds) > 1e6)
            return;
        lab.seconds = seconds;
        part("compared").textContent = "";
        part("time").value = part("slider").value = seconds;
        clearTimeout(timer);
        timer = setTimeout(() => draw(true), WAIT);
        part("error").textContent = await draw(false) || "";
    }

    const FIRST = /^(Wrong first|Below in the picture)/;

    /* A mistake's name, and what is wrong and where only to those who ask. */
    function hint({name, sentence, look, sure}) {
        const more = (title, text) => element("details", {}, element("summary", {}, title), text);
        return element("li", {}, element("b", {}, name), " (" + Math.round(100 * sure) + "% sure)",
                       more("Hint: what is wrong", sentence), more("Hint: where to look", "Look at " + look + "."));
    }

    function tell({verdict, sheet}) {
        const list = (items, title) => items.length ? [element("ul", {"aria-label": title}, ...items)] : [];
        const nodes = [element("p", {class: verdict.verdict === "right" ? "right" : "error"},
                               verdict.verdict + ", " + verdict.points + " of " + verdict.most + " points")];
        if (verdict.mistakes.length !== 1 || verdict.mistakes[0].name !== verdict.message)
            nodes.push(element("p", {}, verdict.message));
        if (verdict.details)
            nodes.push(element("pre", {tabindex: 0}, verdict.details));
        nodes.push(...list((verdict.parts || []).map(({name, state, points, most}) =>
                           element("li", {}, name + ": " + state + ", " + points + " of " + most + " points")), "Parts"),
                   ...list(verdict.mistakes.map(hint), "Mistakes"),
                   ...list(verdict.symptoms.filter(text => !FIRST.test(text)).map(text => element("li", {}, text)), "Symptoms"));
        for (const text of verdict.symptoms.filter(text => FIRST.test(text)))
            nodes.push(element("details", {}, element("summary", {}, "Hint: the value that is wrong first"), text));
        if (sheet) {
            const canvas = element("canvas", {id: "sheet", role: "img",
                                              "aria-label": "The worst scene: drawn, right, difference"});
            Controls.paint(canvas, sheet);
            nodes.push(element("figure", {}, canvas,
                               element("figcaption", {}, "The worst scene: drawn, right, difference")));
        }
        nodes.push(element("details", {}, element("summary", {}, "All scenes"), element("pre", {tabindex: 0}, verdict.text)));
        part("result").replaceChildren(...nodes);
    }

    const task = texts => ({lines: [lab.path], lab: true, own: lab.own, texts, seconds: lab.seconds});

    /* Where, and in which value, the mistake shows first in the picture of the page. Its text is the student's, as checked. */
    async function showFirst(mistakes) {
        const texts = new Map(lab.files.map(({name, text}) => [name, lab.texts.get(name) ?? text]));
        try {
            await Point.load();
            const drawn = await draw(true) === "" && lab.pictures;
            const nodes = drawn ? await Wrong.explain(mistakes, texts, lab.pictures, task) : [];
            if (nodes.length)
                part("result").querySelector(":scope > details:last-child").before(element("details", {},
                    element("summary", {}, "Hint: where it shows first"), ...nodes));
        } catch (error) {
            part("error").textContent = String(error);
        }
    }

    /* As natively: other scenes each time. */
    async function check(seed = crypto.getRandomValues(new Uint32Array(1))[0] & 0x7fffffff) {
        lab.texts = lab.editor.texts();
        part("check").disabled = true;
        part("result").textContent = "Checking...";
        const answer = await ask({what: "check", seed});
        part("check").disabled = false;
        if (!answer || answer.message) {
            part("result").textContent = answer ? short(answer.message) : "";
            return answer;
        }
        tell(answer);
        Progress.keep(lab.name, answer.verdict);
        if (answer.verdict.verdict === "wrong")
            await showFirst(answer.verdict.mistakes);
        return answer.verdict;
    }

    /* `check --class` tells students apart by the archives' names. */
    function handIn() {
        const number = lab.own ? lab.name : lab.name.slice(0, 5);
        const student = part("student").value.trim().replace(/[^\p{L}\p{N}._-]+/gu, "_").replace(/^[._-]+/, "");
        const texts = lab.editor.texts();
        const all = new Map(lab.files.map(({name, text}) => [name, texts.has(name) ? texts.get(name) : text]));
        Controls.save((student || "mine") + "-" + number + ".zip", Zip.encode(all));
    }

    function wipe() {
        const on = part("pictures").classList.toggle("over");
        part("wipe-on").setAttribute("aria-pressed", on);
        part("wipe-row").hidden = !on;
        part("drawn").style.clipPath = "";
        if (on)
            Wipe.show(part("wipe"), part("drawn"));
    }

    function listen() {
        part("wipe-on").addEventListener("click", wipe);
        part("wipe").addEventListener("input", () => Wipe.show(part("wipe"), part("drawn")));
        part("slider").addEventListener("input", event => setTime(Number(event.target.value)));
        part("time").addEventListener("change", event => setTime(Number(event.target.value)));
        part("hand-in").addEventListener("click", handIn);
        if (part("check"))
            part("check").addEventListener("click", () => check());
        LabWorker.lost = () => draw(true);
        lab.point = Point.open({canvas: part("drawn"), line: part("pixel-line"), picture: () => lab.picture, editor: () => lab.editor,
                                task: () => task(lab.shown),
                                put: section => part("compared").before(section)});
        Controls.refuseFiles(name => {
            part("error").textContent = name + ": a page reads no files; paste its text into the editor";
        });
    }

    async function open() {
        const hung = isMarked();
        if (typeof OWN !== "undefined")
            Object.assign(lab, {own: JSON.parse(new TextDecoder().decode(unpack(OWN))), path: "/own/" + lab.name});
        lab.files = JSON.parse(document.body.dataset.files);
        lab.editor = Editor.open(part("editor"), "lighting " + lab.name, lab.files, apply);
        listen();
        part("time").value = part("slider").value = lab.seconds; /* a browser may have filled in others */
        /* The starter, which is there if the text of last time is refused; that is drawn unless it
         * hung the page. */
        const message = lab.editor.edited() ? await draw(true) : "";
        if (message)
            throw message;
        if (!hung || !lab.editor.edited())
            await lab.editor.run();
        if (part("compared").textContent.startsWith("Loading"))
            part("compared").textContent = "";
        document.body.dataset.ready = "yes";
    }

    open().catch(error => {
        part("compared").textContent = "";
        part("error").textContent = "This page cannot run: " + error;
    });
    return {lab, check, draw, setTime};
})();
