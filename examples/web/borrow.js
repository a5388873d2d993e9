"use strict";
/* The page of a device's own arithmetic: a link and a QR code hold what was measured. Opened with such a link, it shows the other's. */
(() => {
    const part = id => document.getElementById(id);
    const QUIET = 4; /* modules around the code */
    const FORM = /^(?:llvmpipe;)?highp=\d+,-\d+,\d+(?:,kept)?(?:,cut)?;mediump=\d+,-\d+,\d+(?:,kept)?(?:,cut)?(?:;bytes=\d+)?$/;

    /* One path; white around it in dark colours, too. */
    function draw(text) {
        const code = qrcode(0, "M");
        code.addData(text);
        code.make();
        const count = code.getModuleCount(), size = count + 2 * QUIET;
        let path = "";
        for (let row = 0; row < count; row++)
            for (let column = 0; column < count; column++)
                path += code.isDark(row, column) ? `M${column + QUIET} ${row + QUIET}h1v1h-1z` : "";
        const made = (name, attributes) => {
            const node = document.createElementNS("http://www.w3.org/2000/svg", name);
            Object.entries(attributes).forEach(([key, value]) => node.setAttribute(key, value));
            return node;
        };
        const picture = made("svg", {viewBox: `0 0 ${size} ${size}`, role: "img", "aria-label": "QR code of " + text, "shape-rendering": "crispEdges"});
        picture.append(made("rect", {width: size, height: size, fill: "#fff"}), made("path", {d: path, fill: "#000"}));
        part("code").replaceChildren(picture);
    }

    function given() {
        try {
            const text = decodeURIComponent(location.hash.slice(1));
            return FORM.test(text) ? text : "";
        } catch {
            return "";
        }
    }

    function show() {
        const other = given(), text = other || Precision.measured();
        part("error").textContent = !text ? "This browser has no WebGL: nothing is measured." :
            location.hash && !other ? "The link holds no device's numbers; these are this device's." : "";
        part("held").hidden = !text;
        if (!text)
            return;
        const link = location.href.replace(/[?#].*/, "") + "#" + text, served = /^http/.test(location.protocol);
        part("whose").textContent = (other ? "Of the device whose link this is: " : "Of this device: ") + text;
        part("link").href = part("link").textContent = link;
        part("again").hidden = !other;
        part("as").href = "PhongBlinn.html?as=" + encodeURIComponent(text) + "#precision=mediump";
        part("command").textContent = `examples/run PhongBlinn --precision mediump --arithmetic "${text}" -o as-that-device.png`;
        if (typeof qrcode !== "undefined")
            draw(served ? link : text); /* nobody else can open a file of this device */
    }

    Precision.fill(document.querySelector("table.precision"));
    show();
    part("copy").addEventListener("click", async () => {
        try {
            await navigator.clipboard.writeText(part("link").href);
            part("said").textContent = "Copied.";
        } catch {
            part("said").textContent = "This browser does not let a page copy; select the link.";
        }
    });
    part("again").addEventListener("click", () => { location.hash = ""; });
    window.addEventListener("hashchange", show);
    document.body.dataset.ready = "yes";
})();
