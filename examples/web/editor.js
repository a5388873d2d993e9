"use strict";
/* The shader files in a text field with numbered lines, under the same text in colours; what has an error is marked. The
 * texts are kept on this device, if it lets us. */
const Editor = (() => {
    const WAIT = 300; /* ms after the last key */
    const COLOURED = 50000; /* letters; longer texts have no colours */
    const INDENT = 4;
    const NOT_KEPT = " This browser keeps nothing: save your text before you leave.";
    const {element} = Controls;

    /* Comments; directives and GLSL's variables; words of the language; numbers and texts. */
    const WORDS = "attribute|uniform|varying|const|static|precision|highp|mediump|lowp|in|out|inout|invariant|if|else|" +
        "for|while|do|return|discard|break|continue|struct|void|bool|int|float|double|char|[bi]?vec[234]|mat[234]|" +
        "sampler2D|samplerCube|true|false";
    const TOKENS = new RegExp("(//.*|/\\*[^]*?(?:\\*/|$(?![^])))|(^[ \\t]*#[ \\t]*\\w*|\\bgl_\\w+)|\\b(" + WORDS +
                              ")\\b|(\\b\\d[\\w.]*|\\.\\d+|\"[^\"\\n]*\")", "gm");
    const KINDS = ["comment", "special", "word", "number"];

    /* The text as spans and strings. */
    function coloured(text) {
        const pieces = [];
        let at = 0;
        for (const match of text.matchAll(TOKENS)) {
            const kind = KINDS[match.slice(1).findIndex(part => part !== undefined)];
            pieces.push(text.slice(at, match.index), element("span", {class: kind}, match[0]));
            at = match.index + match[0].length;
        }
        return [...pieces, text.slice(at)];
    }

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
        const live = part("live"), said = part("said"), colours = part("colours");
        const originals = new Map(shaders.map(({name, text}) => [name, text]));
        const names = [...originals.keys()], edited = new Map(), others = stored(key);
        let marks = [], timer = 0, inside = false;

        /* Others may be read with other options. */
        for (const name of names.filter(name => others.has(name))) {
            edited.set(name, others.get(name));
            others.delete(name);
        }
        const keep = () => store(key, new Map([...edited, ...others])) || !edited.size;
        const text = name => edited.has(name) ? edited.get(name) : originals.get(name);

        function number() {
            const wrong = new Map();
            for (const {name, line, text} of marks)
                if (name === files.value)
                    wrong.set(line, (wrong.has(line) ? wrong.get(line) + "\n" : "") + text);
            const count = field.value.split("\n").length;
            gutter.replaceChildren(...Array.from({length: count}, (_, i) =>
                element("span", wrong.has(i + 1) ? {class: "wrong", title: wrong.get(i + 1)} : {},
                        (wrong.has(i + 1) ? "✖ " : "") + (i + 1) + "\n")));
            scroll();
        }

        function scroll() {
            gutter.scrollTop = field.scrollTop;
            colours.firstChild.style.transform = "translate(" + -field.scrollLeft + "px, " + -field.scrollTop + "px)";
        }

        function colour() {
            const plain = field.value.length > COLOURED;
            field.classList.toggle("plain", plain);
            colours.firstChild.replaceChildren(...plain ? [] : coloured(field.value));
        }

        function show() {
            field.value = text(files.value);
            colour();
            number();
        }

        /* The cursor to a line's beginning. */
        function go({name, line}) {
            files.value = name;
            show();
            const lines = field.value.split("\n"), at = lines.slice(0, line - 1).join("\n").length + (line > 1 ? 1 : 0);
            field.focus();
            inside = true;
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
                !/^[\w./-]+:\d+: |^ *\d+ \| /.test(line)).join("\n") : message || (edited.size ? "Drawn with your text." : "");
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
            inside = true;
            if (field.value === originals.get(files.value))
                edited.delete(files.value);
            else
                edited.set(files.value, field.value);
            colour();
            number();
            if (!keep())
                said.textContent = NOT_KEPT;
            clearTimeout(timer);
            if (live.checked)
                timer = setTimeout(run, WAIT);
        }

        /* Types over a part of the text, so that it can be undone. */
        function put(from, to, text) {
            field.setSelectionRange(from, to);
            if ((from < to || text) && !document.execCommand(text ? "insertText" : "delete", false, text)) {
                field.setRangeText(text, from, to, "end");
                change();
            }
        }

        const lineStart = at => field.value.slice(0, at).lastIndexOf("\n") + 1;

        /* A new line begins as the one before. */
        function breakLine() {
            const {selectionStart: start, selectionEnd: end, value} = field;
            put(start, end, "\n" + value.slice(lineStart(start), start).match(/^[ \t]*/)[0]);
        }

        /* The cursor, or the selected lines. */
        function indent(back) {
            const {selectionStart: start, selectionEnd: end, value} = field, first = lineStart(start);
            const several = value.slice(start, end).includes("\n");
            if (!back && !several)
                return put(start, end, " ".repeat(INDENT - (start - first) % INDENT));
            const found = value.indexOf("\n", Math.max(start, end - 1)), last = found < 0 ? value.length : found;
            const before = value.slice(first, last);
            const after = back ? before.replace(/^(?:\t| {1,4})/gm, "") : before.replace(/^(?=.)/gm, " ".repeat(INDENT));
            if (after === before)
                return;
            put(first, last, after);
            if (several)
                field.setSelectionRange(first, first + after.length);
            else
                field.setSelectionRange(...[start, end].map(at => Math.max(first, at - before.length + after.length)));
        }

        /* Tab indents once something was clicked or typed here, and until Escape: it is no trap for those who pass by. */
        function press(event) {
            const modified = event.ctrlKey || event.altKey || event.metaKey;
            if (event.key === "Enter" && (event.ctrlKey || event.metaKey))
                run();
            else if (event.key === "Enter" && !modified && !event.isComposing)
                breakLine();
            else if (event.key === "Tab" && inside && !modified)
                indent(event.shiftKey);
            else {
                inside = event.key !== "Escape" && (inside || !["Tab", "Shift"].includes(event.key));
                return;
            }
            event.preventDefault();
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
        field.addEventListener("scroll", scroll);
        field.addEventListener("keydown", press);
        field.addEventListener("pointerdown", () => { inside = true; });
        field.addEventListener("blur", () => { inside = false; });
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
