"use strict";
/* Counts what a shader's loops come to before it is drawn: a graphics process that hangs in a shader hangs the page, also
 * when it is loaded again. The browser's compiler takes loops with constant bounds only (GLSL ES 1.00, appendix A), so that
 * they can be counted in the text: a step is a word of it, as often as loops and calls repeat it. What #if leaves out is
 * counted, too; a bound that the program sets is taken for a small one. */
const Loops = (() => {
    const MOST = 300000;     /* steps at each pixel or vertex: seconds of a picture, by a slow renderer */
    const UNKNOWN = 16;      /* turns of a loop whose bounds are not in the text */
    const LONGEST = 2000000; /* words that are read, with macros expanded */
    const WORDS = /[A-Za-z_]\w*|0[xX][\da-fA-F]+|(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|\+\+|--|[-+*/<>=!]=|\S/g;
    const COMMENTS = /\/\/.*|\/\*[^]*?(?:\*\/|$)/g;
    const SIGNS = {"+": (a, b) => a + b, "-": (a, b) => a - b, "*": (a, b) => a * b, "/": (a, b) => a / b};

    let left = 0; /* words that may still be read */

    /* What takes the browser too long to count is not counted. */
    class TooLong extends Error {}
    function spend() {
        if (--left < 0)
            throw new TooLong();
    }

    /* The words of a file and those it includes, [{word, name, line}], and the macros. */
    function read(texts, name, macros, chain = []) {
        const words = [];
        const plain = texts.get(name).replace(COMMENTS, text => text.replace(/[^\n]+/g, " ")).replace(/\\\r?\n/g, " ");
        plain.split("\n").forEach((text, i) => {
            spend();
            const include = text.match(/^\s*#\s*include\s*"([^"]*)"/);
            const define = text.match(/^\s*#\s*define\s+(\w+)(?:\(([^)]*)\))?(.*)/);
            const found = include && [...texts.keys()].find(other => other === include[1] ||
                                                                     other.endsWith("/" + include[1].replace(/.*\//, "")));
            if (found && !chain.includes(found) && chain.length < 32)
                for (const word of read(texts, found, macros, [...chain, name]))
                    words.push(word);
            else if (define) {
                const gives = define[3].match(WORDS) || [], before = macros.get(define[1]);
                if (!before || !(Number(before.gives[0]) > Number(gives[0]))) /* defined twice, a number is the larger one */
                    macros.set(define[1], {takes: define[2] === undefined ? null :
                        define[2].split(",").map(word => word.trim()), gives});
            } else if (!/^\s*#/.test(text))
                for (const word of text.match(WORDS) || []) {
                    spend();
                    words.push({word, name, line: i + 1});
                }
        });
        return words;
    }

    /* A call's arguments at "(", and where it ends. */
    function argumentsAt(words, at) {
        const found = [[]];
        for (let depth = 0; at < words.length; at++) {
            const {word} = words[at];
            depth += (word === "(") - (word === ")");
            if (!depth)
                break;
            if (word === "," && depth === 1)
                found.push([]);
            else if (word !== "(" || depth > 1)
                found[found.length - 1].push(words[at]);
        }
        return {found, end: at + 1};
    }

    function expand(words, macros, out = [], inside = []) {
        for (let i = 0; i < words.length; i++) {
            spend();
            const {word, name, line} = words[i], macro = inside.includes(word) ? null : macros.get(word);
            const called = macro && macro.takes && words[i + 1] && words[i + 1].word === "(";
            if (!macro || (macro.takes && !called)) {
                out.push(words[i]);
                continue;
            }
            const {found, end} = called ? argumentsAt(words, i + 1) : {found: [], end: i + 1};
            const given = new Map(called ? macro.takes.map((take, k) => [take, found[k] || []]) : []);
            expand(macro.gives.flatMap(give => given.get(give) || [{word: give, name, line}]), macros, out, [...inside, word]);
            i = end - 1;
        }
        return out;
    }

    /* A constant expression, {value, whole}; NaN: it is none. */
    function evaluate(words, constants) {
        let at = 0;
        function primary() {
            const word = words[at++];
            if (word === "-" || word === "+") {
                const {value, whole} = primary();
                return {value: word === "-" ? -value : value, whole};
            }
            if (word === "(" || ((word === "float" || word === "int") && words[at++] === "(")) {
                const {value, whole} = sum();
                at += words[at] === ")" ? 1 : 1000;
                return word === "int" ? {value: Math.trunc(value), whole: true} : {value, whole: whole && word !== "float"};
            }
            return constants.get(word) || {value: /^[\d.]/.test(word) ? Number(word) : NaN, whole: /^(?:\d+|0[xX].*)$/.test(word)};
        }
        function chain(next, signs) {
            let left = next();
            while (signs.includes(words[at])) {
                const sign = words[at++], right = next(), whole = left.whole && right.whole;
                const value = SIGNS[sign](left.value, right.value);
                left = {value: whole ? Math.trunc(value) : value, whole};
            }
            return left;
        }
        const product = () => chain(primary, ["*", "/"]), sum = () => chain(product, ["+", "-"]);
        const result = sum();
        return at === words.length ? result : {value: NaN, whole: false};
    }

    /* From a to b by steps; a float that is too large for its step stays. */
    function turns(a, sign, b, step, whole) {
        if ([a, b, step].some(Number.isNaN))
            return UNKNOWN;
        const up = sign[0] === "<", left = sign === "==" ? 0 : (b - a) / step;
        const first = {"<": a < b, "<=": a <= b, ">": a > b, ">=": a >= b, "!=": a !== b, "==": a === b}[sign];
        const most = Math.max(Math.abs(a), Math.abs(b));
        if (!first)
            return 0;
        if (sign === "==")
            return step ? 1 : Infinity;
        const stays = !whole && Math.fround(most - Math.abs(step)) === Math.fround(most);
        if (!step || stays || (sign === "!=" ? left < 0 || left !== Math.trunc(left) : up !== step > 0))
            return Infinity;
        return sign.length === 2 && sign !== "!=" ? Math.floor(left) + 1 : Math.ceil(left);
    }

    /* How often "int i = 0; i < 10; i++" turns. */
    function header(text, constants) {
        const cut = text.join(" ").split(" ; ").map(part => part.split(" ").filter(word => word));
        const [init, test, step] = cut, at = init.indexOf("="), name = init[at - 1];
        if (cut.length !== 3 || at < 1 || test[0] !== name || !step.includes(name))
            return UNKNOWN;
        const start = evaluate(init.slice(at + 1), constants), end = evaluate(test.slice(2), constants);
        const by = step.includes("++") ? 1 : step.includes("--") ? -1 :
            (step[1] === "-=" ? -1 : 1) * evaluate(step.slice(2), constants).value;
        return turns(start.value, test[1], end.value, by, init.includes("int"));
    }

    /* The steps of a shader; tell(word, steps) is called for each loop, inner ones first. */
    function steps(words, tell) {
        const constants = new Map(), functions = new Map(), known = new Map();
        for (let i = 0, depth = 0; i < words.length; i++) {
            const {word} = words[i];
            if (depth === 0 && word === "(" && i > 0) {
                const {end} = argumentsAt(words, i);
                if (words[end] && words[end].word === "{")
                    functions.set(words[i - 1].word, [...functions.get(words[i - 1].word) || [], end]);
                i = end - 1;
            } else {
                depth += (word === "{") - (word === "}");
            }
        }
        let at = 0;
        const here = () => at < words.length ? words[at].word : "}";

        function declare() {
            const begin = at;
            while (at < words.length && here() !== ";")
                at++;
            const text = words.slice(begin, at).map(({word}) => word).join(" ");
            for (const part of text.split(" , ")) {
                const equal = part.indexOf(" = ");
                if (equal < 1)
                    continue;
                const name = part.slice(0, equal).replace(/.* /, ""), before = constants.get(name);
                const now = evaluate(part.slice(equal + 3).split(" "), constants);
                if (!before || !(Math.abs(now.value) <= Math.abs(before.value))) /* in any scope: the larger one */
                    constants.set(name, now);
            }
            return at - begin;
        }

        function call(name) {
            if (!known.has(name)) {
                const before = at;
                known.set(name, 0); /* no recursion */
                known.set(name, Math.max(...functions.get(name).map(begin => { /* the costliest overload */
                    at = begin;
                    return statement();
                })));
                at = before;
            }
            return known.get(name);
        }

        function loop() {
            const word = words[at], {end} = argumentsAt(words, at + 1);
            const count = header(words.slice(at + 2, end - 1).map(({word}) => word), constants);
            at = end;
            const inside = statement() + 4, all = count ? count * inside : 0;
            tell(word, all);
            return all;
        }

        /* The words before `end`, and what they call. */
        function span(end) {
            let count = 0;
            while (at < end && at < words.length) {
                const word = here();
                at++;
                count += 1 + (functions.has(word) && here() === "(" ? call(word) : 0);
            }
            return count;
        }

        function statement() {
            let count = 0;
            if (here() === "{") {
                for (at++; here() !== "}";)
                    count += statement();
                at++;
                return count;
            }
            if (here() === "for")
                return loop();
            if (here() === "if") {
                count = span(argumentsAt(words, at + 1).end) + statement();
                if (here() === "else") {
                    at++;
                    count += statement();
                }
                return count;
            }
            if (here() === "const")
                count += declare();
            for (let depth = 0; at < words.length && (depth || !["{", "}", "for"].includes(here()));) {
                const word = here();
                depth += (word === "(") - (word === ")");
                count += span(at + 1);
                if (word === ";" && depth <= 0)
                    break;
            }
            return count;
        }

        for (let i = 0; i < words.length; i++)
            if (words[i].word === "const") {
                at = i;
                declare();
            }
        return functions.has("main") ? call("main") : 0;
    }

    /* What is said of shaders that would hang the page, like a compiler's error; "" of others. */
    function refuse(texts) {
        for (const name of texts.keys()) {
            if (!/\.(vert|frag)$/.test(name) || ![...texts.values()].some(text => /\bfor\b/.test(text)))
                continue;
            const macros = new Map();
            let found = null;
            left = LONGEST;
            try {
                steps(expand(read(texts, name, macros), macros), (word, count) => {
                    if (count > MOST && !found)
                        found = {...word, count};
                });
            } catch (error) {
                if (error instanceof TooLong)
                    return name + ":1: error: with its macros and what it includes it has more than " +
                        LONGEST.toLocaleString("en") + " words; the page draws shorter ones. Your text is kept.";
                if (!(error instanceof RangeError))
                    throw error;
                /* Deeper than any compiler goes. */
            }
            if (found)
                return found.name + ":" + found.line + ": error: this loop " + (found.count === Infinity ? "never ends" :
                    "takes about " + Number(found.count.toPrecision(2)).toLocaleString("en") + " steps") +
                    "\nThe page draws up to " + MOST.toLocaleString("en") + " at each pixel or vertex, because more may hang " +
                    "the browser. Your text is kept, and not drawn: let the loop turn fewer times, or draw it natively.";
        }
        return "";
    }

    return {refuse};
})();
