"use strict";
/* A shader as its driver gets it, without what its conditions leave out: the text to read. */
const Assembled = (() => {
    /* GLSL's #if of defined(NAME), !, && and ||: true, false, or null for others. */
    function holds(words, defined) {
        const tokens = words.match(/defined|\w+|&&|\|\||[!()]|\S/g) || [];
        let at = 0, known = true;
        const take = token => tokens[at] === token && ++at > 0;
        function atom() {
            if (take("!"))
                return !atom();
            if (take("defined")) {
                const bracket = take("("), name = tokens[at++];
                known = known && (!bracket || take(")"));
                return defined.has(name);
            }
            if (take("(")) {
                const value = any();
                known = known && take(")");
                return value;
            }
            known = false;
            return false;
        }
        function all() {
            let value = atom();
            while (take("&&"))
                value = atom() && value;
            return value;
        }
        function any() {
            let value = all();
            while (take("||"))
                value = all() || value;
            return value;
        }
        const value = any();
        return known && at === tokens.length ? value : null;
    }

    /* Each condition is {kept: its lines are, done: one before was, whole: it is not understood, and stays}. */
    function read(source) {
        const defined = new Set(), stack = [], lines = [];
        const kept = () => stack.every(level => level.kept);
        for (const line of source.split("\n")) {
            const [, word, rest] = line.match(/^\s*#\s*(\w+)\s*(.*?)\s*(?:\/\/.*)?$/) || [];
            const top = stack[stack.length - 1];
            if (word === "if" || word === "ifdef" || word === "ifndef") {
                const value = word === "if" ? holds(rest, defined) : defined.has(rest) === (word === "ifdef");
                stack.push({kept: value !== false, done: value === true, whole: value === null});
            } else if (word === "endif" && top) {
                stack.pop();
                if (top.whole && kept())
                    lines.push(line);
            } else if (["elif", "else"].includes(word) && top && !top.whole) {
                const value = !top.done && (word === "else" || holds(rest, defined));
                Object.assign(top, {kept: value !== false, done: top.done || value !== false});
            } else if (kept() && word !== "line") {
                lines.push(line);
                if (word === "define")
                    defined.add(rest.match(/^\w*/)[0]);
            }
            if (word?.startsWith("if") && kept() && stack[stack.length - 1].whole)
                lines.push(line);
        }
        return lines.join("\n").replace(/\n{3,}/g, "\n\n").trim() + "\n";
    }

    /* What --explain --verbose prints: of each line that an effect calls for, "group.glsl:123  sum += ...", by its text. */
    function receipts(text) {
        const found = new Map();
        let effect = "", light = "";
        for (const line of text.split("\n")) {
            const [, place, source] = line.match(/^ {6}(\S+) {2}(.*)$/) || [];
            if (place) {
                const key = source.replace(/\.\.\.$/, "");
                found.set(key, new Set(found.get(key)).add(effect));
                continue;
            }
            light = /^light \d+/.test(line) ? line.match(/^light \d+/)[0] + ", " : line.startsWith("  ") ? light : "";
            effect = light + line.trim().replace(/:.*/, "");
        }
        return found;
    }

    /* The text's lines, each with the effects that call for it at its end. */
    function show(text, said) {
        const found = [...receipts(said)];
        return text.split("\n").map(line => {
            const code = line.replace(/\/\/.*/, "").trim();
            const effects = found.filter(([key]) => code && (code === key || key.length > 60 && code.startsWith(key)));
            const names = [...new Set(effects.flatMap(([, names]) => [...names]))].join("; ");
            return [line, names && Controls.element("span", {"data-by": names}), "\n"];
        }).flat();
    }

    return {read, show};
})();
