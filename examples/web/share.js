"use strict";
/* What is taken elsewhere: the picture, the link, the command, a film, and the page as a part of another one. */
const Share = (() => {
    const FRAMES = 30; /* a second, of a film */
    const KINDS = ["video/webm;codecs=vp9", "video/webm;codecs=vp8", "video/webm"];
    const {element} = Controls;
    const part = id => document.getElementById(id);
    const say = message => { part("status").textContent = message; };

    async function copy(what, text) {
        try {
            await navigator.clipboard.writeText(await text);
            say("Copied: " + what + ".");
        } catch (error) {
            say(typeof error === "string" ? error : "This browser does not let a page copy; select the text and copy it.");
        }
    }

    /* The picture is a promise, because a browser lets copy only in answer to a press. */
    async function copyPicture(picture) {
        try {
            await navigator.clipboard.write([new ClipboardItem({"image/png": picture})]);
            say("Copied: the picture.");
        } catch {
            say("This browser does not let a page copy pictures; save it as PNG instead.");
        }
    }

    const kind = () => self.MediaRecorder && HTMLCanvasElement.prototype.captureStream &&
        KINDS.find(name => MediaRecorder.isTypeSupported(name));

    let recorder = null;

    /* From one press of the button to the next, what the canvas shows. play(on) is called at both. */
    function record(canvas, name, play) {
        if (recorder)
            return recorder.stop();
        const chunks = [], button = part("record");
        recorder = new MediaRecorder(canvas.captureStream(FRAMES), {mimeType: kind(), videoBitsPerSecond: 8e6});
        recorder.addEventListener("dataavailable", event => chunks.push(event.data));
        recorder.addEventListener("stop", () => {
            recorder.stream.getTracks().forEach(track => track.stop());
            recorder = null;
            button.textContent = "Record WebM";
            play(false);
            Controls.save(name + ".webm", new Blob(chunks, {type: "video/webm"}));
            say("Saved: what was recorded.");
        });
        recorder.start();
        button.textContent = "Stop and save";
        say("Recording...");
        play(true);
    }

    const quoted = text => text.replace(/&/g, "&amp;").replace(/"/g, "&quot;").replace(/</g, "&lt;");

    /* The HTML of an iframe with these controls. A file's address would be of this device alone. */
    function frame(link, chosen, {name, width, height}) {
        const page = location.protocol === "file:" ? name + ".html" : location.href.replace(/[?#].*/, "");
        const address = page + "?embed" + (chosen.length ? "=" + chosen.join(",") : "") + (link && "#" + link);
        return `<iframe src="${quoted(address)}" width="${Math.max(320, width + 20)}" height="${height + 140 + 80 * chosen.length}"` +
            ` title="${quoted(name)}, drawn live" loading="lazy" style="border: 0"></iframe>`;
    }

    /* The list of controls to choose from; `text()` is a promise of the HTML for those that are chosen. */
    function embed(options, text) {
        const boxes = options.map(({name}) => element("input", {type: "checkbox", value: name}));
        const chosen = () => boxes.filter(box => box.checked).map(box => box.value);
        const show = async () => { part("iframe").value = await text(chosen()).catch(String); };
        part("embed-controls").append(...boxes.map(box => element("label", {}, box, " " + Controls.title(box.value))));
        part("embed-controls").addEventListener("input", show);
        part("embed").addEventListener("toggle", show);
        part("copy-iframe").addEventListener("click", () => {
            const html = text(chosen());
            html.then(value => { part("iframe").value = value; }, () => {});
            copy("the iframe's HTML", html);
        });
    }

    return {copy, copyPicture, record, canRecord: () => Boolean(kind()), frame, embed};
})();
