"use strict";
/* Deep links: the options of the command line after #, as in #time=2&material=gold&alpha. */
const Link = (() => {
    const LONGEST = 4000;
    const LONGEST_TEXTS = 100000; /* packed, in letters */
    const LONGEST_FILE = 1000000; /* unpacked, in bytes */

    const TEXTS = "text=";

    /* A Map of names and texts; throws a text that says what is wrong. */
    function read(hash) {
        const values = new Map(), parts = hash.replace(/^#/, "").split("&").filter(part => part && !part.startsWith(TEXTS));
        if (parts.join("&").length > LONGEST)
            throw "link: more than " + LONGEST + " letters";
        for (const part of parts) {
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

    /* Of shader texts, which a link has packed beside the options: "", or as they are. */
    function packed(hash) {
        const found = hash.replace(/^#/, "").split("&").find(part => part.startsWith(TEXTS));
        return found ? found.slice(TEXTS.length) : "";
    }

    /* The whole of a link. */
    const join = (values, texts) => [write(values), texts && TEXTS + texts].filter(part => part).join("&");

    /* A Map of names and texts as JSON, deflated, in base64url. */
    async function pack(texts) {
        if (!texts.size)
            return "";
        const bytes = await Zip.deflate(new TextEncoder().encode(JSON.stringify([...texts])));
        const text = btoa(Array.from(bytes, byte => String.fromCharCode(byte)).join(""));
        if (text.length > LONGEST_TEXTS)
            throw "The texts are too long for a link: save them as ZIP.";
        return text.replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
    }

    /* Throws a text that says what is wrong. */
    async function unpack(text) {
        let pairs;
        if (text.length > LONGEST_TEXTS)
            throw "link: more than " + LONGEST_TEXTS + " letters of shader texts";
        try {
            const bytes = Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), letter => letter.charCodeAt(0));
            pairs = JSON.parse(Zip.decoded(await Zip.inflate(bytes, LONGEST_FILE)));
        } catch {
            throw "link: its shader texts are damaged; ask for the link again";
        }
        const right = pair => Array.isArray(pair) && pair.length === 2 && pair.every(text => typeof text === "string");
        if (!Array.isArray(pairs) || !pairs.every(right))
            throw "link: its shader texts are none";
        return new Map(pairs);
    }

    /* Who writes embed after the # means it before: that address; "" if there is none. */
    function embedding({hash, search}) {
        const parts = hash.replace(/^#/, "").split("&"), isIt = part => /^embed(=|$)/.test(part), found = parts.find(isIt);
        return found ? `?${[...search.slice(1).split("&"), found].filter(part => part).join("&")}#${parts.filter(part => !isIt(part)).join("&")}` : "";
    }

    return {read, write, packed, join, pack, unpack, embedding};
})();
