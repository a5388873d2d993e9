"use strict";
/* Models and scenes that are chosen or dropped. reader.js, a module that reads them and draws all that the page draws, is loaded
 * then; a worker reads, within a time, and the page's own module checks what it answers, as natively the child process of a
 * reader. Nothing leaves the device. */
const Files = (() => {
    const READ = /\.(obj|ply|gltf|glb)$/i;
    const part = id => document.getElementById(id);
    const option = document.body.dataset.program === "Scene" ? "file" : "model";
    let name = "", taken = null, worker = null, compiled = null;

    function work() {
        self.onmessage = async ({data: {module, files, line}}) => {
            let engine = null;
            try {
                engine = await Engine.open({module, files, answer: new Blob([])}, new OffscreenCanvas(1, 1));
                engine.run(line);
            } catch (end) {
                /* The child's exit, or its crash: its answer tells. */
            }
            const answer = engine ? engine.module.FS.readFile("/answer") : new Uint8Array();
            self.postMessage({answer, message: engine && !answer.length ? engine.message : ""});
        };
    }

    const failure = (file, why) => file + ": cannot read: " + why + "; is it damaged?";

    /* Bytes, or throws why there are none. */
    function read(module, files, file) {
        const bytes = files.reduce((sum, {blob}) => sum + blob.size, 0);
        return new Promise((resolve, reject) => {
            const end = (give, value) => {
                clearTimeout(timer);
                worker?.terminate();
                worker = null;
                give(value);
            };
            worker?.terminate();
            const timer = setTimeout(() => end(reject, failure(file, "it takes too much time or memory")), 10000 + bytes / 1000);
            worker = startWorker(work, READER);
            worker.onmessage = ({data: {answer, message}}) => answer.length ? end(resolve, answer) :
                end(reject, message || failure(file, "the reader failed on it"));
            worker.onerror = () => end(reject, failure(file, "the reader failed on it"));
            worker.postMessage({module, files, line: [document.body.dataset.program, "--" + option + "=" + file]});
        });
    }

    /* Of a folder all that is in it, by its path there. */
    async function list(entry, path, files) {
        if (entry.isFile)
            files.push({name: path + entry.name, blob: await new Promise((resolve, reject) =>
                entry.file(resolve, () => reject(path + entry.name + ": cannot be read here; choose or drop the files alone")))});
        for (const reader = entry.isDirectory && entry.createReader(); reader;) {
            const some = await new Promise((resolve, reject) => reader.readEntries(resolve, reject));
            if (!some.length || files.length > 10000)
                break;
            for (const one of some)
                await list(one, path + entry.name + "/", files);
        }
    }

    /* Files as the browser gives them: a page that is opened from disk gets no others. */
    async function dropped(transfer) {
        const files = [], given = [...transfer.files].map(blob => ({name: blob.name, blob}));
        const entries = [...transfer.items].map(item => item.webkitGetAsEntry()).filter(entry => entry);
        if (entries.every(entry => entry.isFile))
            return given;
        for (const entry of entries)
            await list(entry, "", files);
        const alone = entries.length === 1 ? entries[0].name.length + 1 : 0;
        return files.map(({name, blob}) => ({name: name.slice(alone), blob}));
    }

    /* What Engine.open is given: the module, and what it reads. Throws a text. */
    async function open(files) {
        const found = files.filter(file => READ.test(file.name)).sort((a, b) => a.name.split("/").length - b.name.split("/").length)[0];
        const shown = (found || files[0] || {name: "a file"}).name.replace(/\p{Cc}/gu, " ").slice(0, 100);
        if (!found)
            throw shown + ": a page reads models of .obj, .ply, .gltf and .glb; the command reads other formats, too: examples/run " +
                document.body.dataset.program + (option === "file" ? " FILE" : " --model FILE");
        if (shown !== found.name)
            throw shown + ": rename it without control characters, shorter than 100 letters";
        part("files-said").textContent = "Reading " + shown + "...";
        if (typeof READER === "undefined")
            await loadScript("reader.js");
        const module = await (compiled ||= compileLighting(READER));
        const answer = new Blob([await read(module, files, found.name)]);
        programModule.now = READER;
        name = found.name;
        return {module, files: [{name, blob: new Blob(["-"])}], answer};
    }

    /* take({module, files, answer}) is called for files that were read; say(text) for others. */
    function listen(take, say) {
        const begin = async files => {
            part("files-said").textContent = "";
            const before = [name, taken, programModule.now];
            try {
                taken = await open(await files);
                await take(taken);
                part("files-said").textContent = name + " is drawn. It stays on this device; a link does not have it.";
            } catch (error) {
                [name, taken, programModule.now] = before;
                part("files-said").textContent = "";
                say(String(error));
            }
        };
        part("choose-file").addEventListener("click", () => part("file").click());
        part("file").addEventListener("change", () => {
            if (part("file").files.length)
                begin([...part("file").files].map(blob => ({name: blob.name, blob})));
            part("file").value = "";
        });
        for (const kind of ["dragover", "drop"])
            window.addEventListener(kind, event => {
                if (!event.dataTransfer.types.includes("Files"))
                    return;
                event.preventDefault();
                if (kind === "drop")
                    begin(dropped(event.dataTransfer));
            });
    }

    return {listen, option, arguments: () => name ? ["--" + option + "=" + name] : [],
            module: () => taken ? [taken, READER] : null};
})();
