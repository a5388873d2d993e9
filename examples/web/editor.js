"use strict";
/* The shader files in a text field with numbered lines, under the same text in colours; what has an error is marked. Only
 * the lines that show have numbers and colours, so that a change costs the same in any text. The texts are kept on this
 * device, if it lets us; a text that another tab keeps is this tab's, too. */
const Editor = (() => {
    const WAIT = 300; /* ms after the last key */
    const COLOURED = 50000; /* letters; more that show at once have no colours */
    const MOST = 5000; /* of them, where drawing takes long: twice its time */
    const INDENT = 4;
    const LONGEST = 1000000; /* bytes of a file that is opened */
    const NOT_KEPT = " This browser keeps nothing: save your text before you leave.";
    const {element} = Controls;

    /* Comments; directives and GLSL's variables; words of the language; numbers and texts. */
    const WORDS = "attribute|uniform|varying|const|static|precision|highp|mediump|lowp|in|out|inout|invariant|if|else|" +
        "for|while|do|return|discard|break|continue|struct|void|bool|int|float|double|char|[bi]?vec[234]|mat[234]|" +
        "sampler2D|samplerCube|true|false";
    const TOKENS = new RegExp("(//.*|/\\*[^]*?(?:\\*/|$(?![^])))|(^[ \\t]*#[ \\t]*\\w*|\\bgl_\\w+)|\\b(" + WORDS +
                              ")\\b|(\\b\\d[\\w.]*|\\.\\d+|\"[^\"\\n]*\")", "gm");
    const COMMENTS = /\/\/.*|\/\*[^]*?(?:\*\/|$)/g;
    const KINDS = ["comment", "special", "word", "number"];

    /* The text between two places as spans and strings; a comment may begin before them. */
    function coloured(text, from, to) {
        const pieces = [];
        let at = from;
        TOKENS.lastIndex = beginning(text, from);
        for (let match; (match = TOKENS.exec(text)) && match.index < to;) {
            const kind = KINDS[match.slice(1).findIndex(part => part !== undefined)];
            const start = Math.max(match.index, from), end = Math.min(TOKENS.lastIndex, to);
            if (end > from) {
                pieces.push(text.slice(at, start), element("span", {class: kind}, text.slice(start, end)));
                at = end;
            }
        }
        return [...pieces, text.slice(at, to)];
    }

    /* Where the comment begins that goes on at a line's beginning; else the line's. */
    function beginning(text, at) {
        for (const match of text.slice(0, at).matchAll(COMMENTS))
            if (match.index + match[0].length >= at && !match[0].startsWith("//"))
                return match.index;
        return at;
    }

    /* The texts are kept one by one, so that several tabs keep theirs: a file's key is the page's and its name. */
    const place = (key, name) => key + ": " + name;

    /* null: nothing is kept, or can be. */
    function recall(key, name) {
        try {
            return localStorage.getItem(place(key, name));
        } catch {
            return null;
        }
    }

    /* False if nothing can be kept. */
    function keep(key, name, text) {
        try {
            if (text === null)
                localStorage.removeItem(place(key, name));
            else
                localStorage.setItem(place(key, name), text);
            return true;
        } catch {
            return text === null;
        }
    }

    /* The names of all files of which a text is kept. Earlier versions kept them all in one. */
    function kept(key) {
        try {
            const pairs = JSON.parse(localStorage.getItem(key) || "[]").filter(pair =>
                Array.isArray(pair) && pair.length === 2 && pair.every(text => typeof text === "string"));
            if (pairs.every(([name, text]) => recall(key, name) !== null || keep(key, name, text)))
                localStorage.removeItem(key);
        } catch { /* then it is none of ours */ }
        try {
            const start = place(key, "");
            return Object.keys(localStorage).filter(name => name.startsWith(start)).map(name => name.slice(start.length));
        } catch {
            return [];
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
        const names = [...originals.keys()], edited = new Map();
        const seen = new Map(names.map(name => [name, null])); /* what is kept of each */
        const unkept = new Set(); /* the names of texts that could not be kept */
        let marks = [], timer = 0, pending = false, inside = false, took = 0;
        let borrowed = false, held = false; /* texts that are not the reader's; which are not drawn yet */

        const text = name => edited.has(name) ? edited.get(name) : originals.get(name);

        /* The files whose kept text is not ours: another tab's, or that of last time. */
        function recallAll() {
            return names.filter(name => {
                const now = recall(key, name);
                if (borrowed || now === seen.get(name) || unkept.has(name))
                    return false;
                seen.set(name, now);
                if (now === null)
                    edited.delete(name);
                else
                    edited.set(name, now);
                return true;
            });
        }

        /* As it is laid out, which is not quite what the style says. */
        function lineHeight(value) {
            const style = getComputedStyle(field), padding = parseFloat(style.paddingTop) + parseFloat(style.paddingBottom);
            let count = 1;
            for (let at = -1; (at = value.indexOf("\n", at + 1)) >= 0;)
                count++;
            return field.scrollHeight > field.clientHeight ? (field.scrollHeight - padding) / count :
                parseFloat(style.lineHeight) || 19;
        }

        function keepOne(name, value) {
            if (borrowed)
                return;
            if (!keep(key, name, value)) {
                unkept.add(name);
                return;
            }
            unkept.delete(name);
            seen.set(name, value);
        }

        /* Lines are numbered and coloured where they show. */
        function show() {
            const value = field.value, height = lineHeight(value);
            const first = Math.max(0, Math.floor(field.scrollTop / height) - 1);
            const last = first + Math.ceil(field.clientHeight / height) + 2;
            let line = 0, from = 0;
            while (line < first && value.indexOf("\n", from) >= 0) {
                from = value.indexOf("\n", from) + 1;
                line++;
            }
            const wrong = new Map(), numbers = [];
            for (const {name, line, text} of marks)
                if (name === files.value)
                    wrong.set(line, (wrong.has(line) ? wrong.get(line) + "\n" : "") + text);
            const shift = line * height - field.scrollTop;
            let to = from;
            for (; line < last && to >= 0; line++) {
                const number = line + 1;
                numbers.push(element("span", wrong.has(number) ? {class: "wrong", title: wrong.get(number)} : {},
                                     (wrong.has(number) ? "✖ " : "") + number + "\n"));
                to = value.indexOf("\n", to) + 1 || -1;
            }
            to = to < 0 ? value.length : to;
            const plain = to - from > COLOURED;
            field.classList.toggle("plain", plain);
            colours.firstChild.replaceChildren(...plain ? [] : coloured(value, from, to));
            colours.firstChild.style.transform = "translate(" + -field.scrollLeft + "px, " + shift + "px)";
            gutter.firstChild.replaceChildren(...numbers);
            gutter.firstChild.style.transform = "translate(0, " + shift + "px)";
        }

        /* Once a frame. */
        function showSoon() {
            if (!pending)
                requestAnimationFrame(() => { pending = false; show(); });
            pending = true;
        }

        function put(name) {
            files.value = name;
            field.value = text(name);
            show();
        }

        /* The cursor to a line's beginning. */
        function go({name, line}) {
            if (files.value !== name)
                put(name);
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
            said.textContent += unkept.size ? NOT_KEPT : "";
            show();
        }

        const texts = () => edited.size ? new Map(names.map(name => [name, text(name)])) : new Map();

        async function run() {
            clearTimeout(timer);
            held = false;
            const start = performance.now(), message = await apply(texts());
            took = performance.now() - start;
            if (message !== null)
                tell(message);
        }

        function change() {
            const name = files.value, value = field.value, same = value === originals.get(name);
            inside = true;
            if (same)
                edited.delete(name);
            else
                edited.set(name, value);
            keepOne(name, same ? null : value);
            if (unkept.size)
                said.textContent = NOT_KEPT;
            showSoon();
            clearTimeout(timer);
            if (live.checked && !held)
                timer = setTimeout(run, Math.min(MOST, Math.max(WAIT, 2 * took)));
        }

        /* What another tab has kept is shown; what is drawn changes when something is typed here. */
        function join() {
            const changed = recallAll();
            if (changed.includes(files.value) && field.value !== text(files.value))
                put(files.value);
            if (changed.length)
                said.textContent = changed.some(name => edited.has(name)) ?
                    "Your text of another tab; Apply draws with it." : "The original, as in another tab; Apply draws it.";
        }

        /* Types over a part of the text, so that it can be undone. */
        function type(from, to, text) {
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
            type(start, end, "\n" + value.slice(lineStart(start), start).match(/^[ \t]*/)[0]);
        }

        /* The cursor, or the selected lines. */
        function indent(back) {
            const {selectionStart: start, selectionEnd: end, value} = field, first = lineStart(start);
            const several = value.slice(start, end).includes("\n");
            if (!back && !several)
                return type(start, end, " ".repeat(INDENT - (start - first) % INDENT));
            const found = value.indexOf("\n", Math.max(start, end - 1)), last = found < 0 ? value.length : found;
            const before = value.slice(first, last);
            const after = back ? before.replace(/^(?:\t| {1,4})/gm, "") : before.replace(/^(?=.)/gm, " ".repeat(INDENT));
            if (after === before)
                return;
            type(first, last, after);
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
            const lost = [...new Set([...edited.keys(), ...borrowed ? [] : kept(key)])];
            if (lost.length && !confirm("Discard your text of " + lost.join(", ") + "?"))
                return;
            for (const name of lost)
                keepOne(name, null);
            edited.clear();
            put(files.value);
            run();
        }

        const save = () => Controls.save(files.value.replace(/.*\//, ""), new Blob([field.value], {type: "text/plain"}));

        /* The texts in place of all that were here. */
        function take(others) {
            edited.clear();
            for (const [name, value] of others)
                if (value !== originals.get(name))
                    edited.set(name, value);
            tell("");
            put([...edited.keys()][0] || files.value);
        }

        /* Others' texts are shown, neither kept nor drawn; null: the reader's own again. */
        function borrow(others) {
            clearTimeout(timer);
            borrowed = held = others !== null;
            if (!borrowed)
                names.forEach(name => seen.set(name, null));
            take(others || new Map());
            if (!borrowed)
                showKept();
            else
                said.textContent = "The link's text, not drawn yet.";
        }

        /* What is here becomes the reader's; false if the reader would lose another text and does not want to. */
        function own() {
            const lost = names.filter(name => ![null, text(name)].includes(recall(key, name)));
            if (lost.length && !confirm("Discard your own text of " + lost.join(", ") + "?"))
                return false;
            borrowed = held = false;
            for (const name of names)
                keepOne(name, edited.has(name) ? edited.get(name) : null);
            return true;
        }

        /* Those of last time. Not applied: if it hung the page, it would again. */
        function showKept() {
            recallAll();
            const [last] = edited.keys();
            put(last || files.value);
            if (last)
                said.textContent = "Your text of last time; Apply draws with it.";
        }

        /* As `--shaders` finds it in a folder. */
        const inFolder = name => name.replace(/^lecture\//, "");

        function saveAll() {
            Controls.save(key.replace(/.* /, "") + "-shaders.zip",
                          Zip.encode(new Map(names.map(name => ["mine/" + inFolder(name), text(name)]))));
        }

        /* Which file is meant, in whatever folder it is; null: none of these. */
        function meant(path) {
            const ends = name => ("/" + path).endsWith("/" + inFolder(name));
            return names.filter(ends).sort((a, b) => b.length - a.length)[0] || null;
        }

        async function read(file) {
            const name = meant(file.name);
            if (name)
                return new Map([[name, await file.text()]]);
            return Zip.decode(await file.arrayBuffer(), meant, LONGEST);
        }

        /* Archives and single files, chosen by the reader. */
        async function load(chosen) {
            const found = new Map();
            for (const file of chosen)
                try {
                    const texts = await read(file);
                    if (!texts.size)
                        throw "has none of these files: " + names.map(inFolder).join(", ");
                    texts.forEach((value, name) => found.set(name, value.replace(/\r\n?/g, "\n")));
                } catch (error) {
                    said.textContent = file.name + ": " + (typeof error === "string" ? error : "is damaged, or none of " +
                        names.map(inFolder).join(", ") + " and no ZIP archive of them");
                    return;
                }
            const lost = [...found.keys()].filter(name => edited.has(name) && edited.get(name) !== found.get(name));
            if (!found.size || lost.length && !confirm("Discard your text of " + lost.join(", ") + "?"))
                return;
            take(new Map([...edited, ...found]));
            for (const name of found.keys())
                keepOne(name, edited.has(name) ? edited.get(name) : null);
            run();
        }

        files.append(...names.map(name => element("option", {value: name}, name)));
        gutter.append(element("span"));
        files.addEventListener("change", () => put(files.value));
        field.addEventListener("input", change);
        field.addEventListener("scroll", show);
        field.addEventListener("keydown", press);
        field.addEventListener("pointerdown", () => { inside = true; });
        field.addEventListener("blur", () => { inside = false; });
        new ResizeObserver(showSoon).observe(field);
        for (const kind of ["storage", "focus", "pageshow"])
            window.addEventListener(kind, join);
        part("apply").addEventListener("click", run);
        part("revert").addEventListener("click", revert);
        part("save").addEventListener("click", save);
        if (part("all"))
            part("all").addEventListener("click", saveAll);
        part("open").addEventListener("click", () => part("chosen").click());
        part("chosen").addEventListener("change", async event => {
            await load([...event.target.files]);
            event.target.value = ""; /* the same once more is a change */
        });
        kept(key);
        showKept();
        return {run, texts, names, go, edited: () => edited.size > 0, changed: () => new Map(edited), borrow, own,
                strange: others => [...others.keys()].find(name => !originals.has(name))};
    }

    return {open};
})();
