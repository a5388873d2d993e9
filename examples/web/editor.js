"use strict";
/* The shader files in a text field with numbered lines; what has an error is marked. The texts are kept on this device, if
 * it lets us. */
const Editor = (() => {
    const WAIT = 300; /* ms after the last key */
    const NOT_KEPT = " This browser keeps nothing: save your text before you leave.";
    const {element} = Controls;

    function stored(key) {
        try {
            const pairs = JSON.parse(localStorage.getItem(key) || "[]");
            return new Map(pairs.filter(pair => Array.isArray(pair) && pair.length === 2 &&
                                                pair.every(text => typeof text === "string")));
        } catch {
            return new Map();
        }
    }

    /* False if nothing can be kept. */
    function store(key, texts) {
        try {
            if (texts.size)
                localStorage.setItem(key, JSON.stringify([...texts]));
            else
                localStorage.removeItem(key);
            return true;
        } catch {
            return false;
        }
    }

    /* [{name, line, text}] of a compiler's message. */
    function errors(message, names) {
        const found = [];
        for (const text of message.split("\n")) {
            const match = text.match(/^([\w./-]+):(\d+): (.*)$/);
            if (match && names.includes(match[1]))
                found.push({name: match[1], line: +match[2], text: match[3]});
        }
        return found;
    }

    /* `shaders`: [{name, text}]; apply(Map of all files, or none if all are as they were) returns a message, "" if they draw,
     * null if others are drawn already; or a promise of it. */
    function open(root, key, shaders, apply) {
        const part = name => root.querySelector("." + name);
        const field = part("source"), gutter = part("gutter"), files = part("files"), list = part("errors");
        const live = part("live"), said = part("said");
        const originals = new Map(shaders.map(({name, text}) => [name, text]));
        const names = [...originals.keys()], edited = new Map(), others = stored(key);
        let marks = [], timer = 0;

        /* Others may be read with other options. */
        for (const name of names.filter(name => others.has(name))) {
            edited.set(name, others.get(name));
            others.delete(name);
        }
        const keep = () => store(key, new Map([...edited, ...others])) || !edited.size;
        const text = name => edited.has(name) ? edited.get(name) : originals.get(name);

        function number() {
            const wrong = new Set(marks.filter(({name}) => name === files.value).map(({line}) => line));
            const count = field.value.split("\n").length;
            gutter.replaceChildren(...Array.from({length: count}, (_, i) =>
                element("span", wrong.has(i + 1) ? {class: "wrong"} : {}, (wrong.has(i + 1) ? "✖ " : "") + (i + 1) +
                        "\n")));
            gutter.scrollTop = field.scrollTop;
        }

        function show() {
            field.value = text(files.value);
            number();
        }

        /* The cursor to a line's beginning. */
        function go({name, line}) {
            files.value = name;
            show();
            const lines = field.value.split("\n"), at = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
            field.focus();
            field.setSelectionRange(at, at + (lines[line - 1] || "").length);
            field.scrollTop = Math.max(0, (line - 5) * field.scrollHeight / lines.length);
        }

        function tell(message) {
            marks = errors(message, names);
            const places = marks.map(mark => {
                const button = element("button", {type: "button"}, mark.name + ":" + mark.line + ": " + mark.text);
                button.addEventListener("click", () => go(mark));
                return element("li", {}, button);
            });
            list.replaceChildren(...places);
            const bad = marks.filter(mark => !mark.text.startsWith("warning:")).length;
            const count = bad ? "Errors: " + bad + "\n" : "Warnings: " + marks.length + "\n";
            said.textContent = marks.length ? count + message.split("\n").filter(line =>
                !/^[\w./-]+:\d+: /.test(line)).join("\n") : message || (edited.size ? "Drawn with your text." : "");
            number();
        }

        const texts = () => edited.size ? new Map(names.map(name => [name, text(name)])) : new Map();

        async function run() {
            clearTimeout(timer);
            const kept = keep();
            const message = await apply(texts());
            if (message === null)
                return;
            tell(message);
            if (!kept)
                said.textContent += NOT_KEPT;
        }

        function change() {
            if (field.value === originals.get(files.value))
                edited.delete(files.value);
            else
                edited.set(files.value, field.value);
            number();
            if (!keep())
                said.textContent = NOT_KEPT;
            clearTimeout(timer);
            if (live.checked)
                timer = setTimeout(run, WAIT);
        }

        function revert() {
            const lost = [...edited.keys(), ...others.keys()];
            if (lost.length && !confirm("Discard your text of " + lost.join(", ") + "?"))
                return;
            edited.clear();
            others.clear();
            show();
            run();
        }

        const save = () => Controls.save(files.value.replace(/.*\//, ""), new Blob([field.value], {type: "text/plain"}));

        files.append(...names.map(name => element("option", {value: name}, name)));
        files.addEventListener("change", show);
        field.addEventListener("input", change);
        field.addEventListener("scroll", () => { gutter.scrollTop = field.scrollTop; });
        field.addEventListener("keydown", event => {
            if (event.key === "Enter" && (event.ctrlKey || event.metaKey)) {
                event.preventDefault();
                run();
            }
        });
        part("apply").addEventListener("click", run);
        part("revert").addEventListener("click", revert);
        part("save").addEventListener("click", save);
        const last = [...edited.keys()][0];
        if (last)
            files.value = last;
        show();
        /* Not applied: if it hung the page, it would again. */
        if (last)
            said.textContent = "Your text of last time; Apply draws with it.";
        return {run, texts, edited: () => edited.size > 0};
    }

    return {open};
})();
