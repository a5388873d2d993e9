"use strict";
/* What accuracy costs on this device: the time of a frame of each row's picture, drawn in turn with the others. */
(() => {
    const ROUNDS = 5, FRAMES = 3; /* a round's frames of one picture; the first is not counted */
    const median = times => times.sort((a, b) => a - b)[times.length >> 1];

    async function measure(part, rows) {
        await Book.begin();
        const {engine} = Book.book, times = rows.map(() => []);
        for (let i = 0; i < ROUNDS * rows.length; i++) {
            const {name, values} = Book.read(rows[i % rows.length].dataset.words);
            if (engine.run(Book.lines(name, values)) !== 0)
                throw new Error(engine.message);
            for (let frame = 0; frame <= FRAMES; frame++) {
                const start = performance.now();
                engine.draw(0, [0, 0, 1, 0]);
                if (frame)
                    times[i % rows.length].push(performance.now() - start);
            }
            await new Promise(done => setTimeout(done));
        }
        const medians = times.map(median);
        rows.forEach((row, i) => { row.lastChild.textContent = `${medians[i].toFixed(1)} ms: ${(medians[i] / medians[0]).toFixed(2)}`; });
        part.querySelectorAll("[hidden]").forEach(cell => { cell.hidden = false; });
    }

    for (const part of document.querySelectorAll(".costs")) {
        const button = part.querySelector("button"), said = part.querySelector("[role=status]");
        button.hidden = false;
        if (!document.querySelector(".live, .formula")) /* nothing else on this page loads it */
            button.textContent += `: loads ${button.dataset.loads} kB`;
        button.addEventListener("click", () => {
            button.disabled = true;
            said.textContent = "Measuring...";
            measure(part, [...part.querySelectorAll("[data-words]")])
                .then(() => { said.textContent = "Medians of a frame, with the copy to the page, and over that of the first row."; })
                .catch(error => { said.textContent = String(error.message || error); })
                .finally(() => { button.disabled = false; Book.renew(); });
        });
    }
})();
