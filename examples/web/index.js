"use strict";
/* Draws each program small, one a frame. */
(async () => {
    const said = document.getElementById("error");
    try {
        const engine = await Engine.open(await compileLighting(), document.createElement("canvas"));
        for (const canvas of document.querySelectorAll("canvas[data-program]")) {
            await new Promise(requestAnimationFrame);
            if (engine.run([canvas.dataset.program]) !== 0 || !engine.draw(0, [0, 0, 1])) {
                said.textContent += `${canvas.dataset.program} cannot be drawn: ${engine.message} `;
                continue;
            }
            const picture = engine.picture();
            canvas.width = picture.width;
            canvas.height = picture.height;
            canvas.getContext("2d").putImageData(picture, 0, 0);
        }
        document.body.dataset.ready = "yes";
    } catch (error) {
        said.textContent = "The pictures cannot be drawn: " + error;
    }
})();
