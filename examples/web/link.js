"use strict";
/* Deep links: the options of the command line after #, as in #time=2&material=gold&alpha. */
const Link = (() => {
    const LONGEST = 4000;

    /* A Map of names and texts; throws a text that says what is wrong. */
    function read(hash) {
        const values = new Map();
        if (hash.length > LONGEST)
            throw "link: more than " + LONGEST + " letters";
        for (const part of hash.replace(/^#/, "").split("&").filter(part => part)) {
            let word;
            try {
                word = decodeURIComponent(part);
            } catch {
                throw "link: " + part.slice(0, 80) + ": not a text";
            }
            if (/[\0-\x1f\x7f]/.test(word))
                throw "link: " + word.slice(0, 80).replace(/[\0-\x1f\x7f]/g, " ") + ": control characters";
            const [, name, value] = word.match(/^([^=]*)=?(.*)$/s);
            if (!/^[a-z][a-z-]*$/.test(name))
                throw "link: " + name.slice(0, 80) + ": not an option";
            values.set(name, word.includes("=") ? value : true);
        }
        return values;
    }

    /* What stands for itself after # stays readable. */
    const escape = text => encodeURIComponent(text).replace(/%2C/g, ",").replace(/%2F/g, "/").replace(/%3A/g, ":");

    function write(values) {
        return [...values].map(([name, value]) => value === true ? name : name + "=" + escape(value)).join("&");
    }

    return {read, write};
})();
