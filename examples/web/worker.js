"use strict";
/* The exact picture takes a second or more: it is computed in a worker, which has the module and a canvas of its own. */
const ErrorWorker = (() => {
    let worker = null, answer = null;

    function work() {
        self.onmessage = async ({data}) => {
            try {
                const engine = await Engine.open(data.compiled, new OffscreenCanvas(1, 1));
                const drawn = engine.replace(data.texts) && engine.run(data.lines) === 0 &&
                              engine.draw(data.seconds, data.orbit);
                const error = drawn && JSON.parse(engine.module.ccall("page_error", "string", ["number"], [+!!data.exact]) || "null");
                self.postMessage(error ? {error, map: engine.picture()} : {message: engine.message});
            } catch (error) {
                self.postMessage({message: String(error)});
            }
        };
    }

    /* What is being computed is answered by `message`. */
    function cancel(message) {
        if (!worker)
            return;
        worker.terminate();
        worker = null;
        answer({message});
    }

    /* {error, map}, where `exact` is asked with the exact picture as the map, or {message}; no message if another one is computed instead. */
    function compute(task) {
        cancel();
        return new Promise(resolve => {
            answer = resolve;
            worker = startWorker(work);
            worker.onmessage = ({data}) => { resolve(data); cancel(); };
            worker.onerror = event => cancel(event.message || "this browser starts no worker");
            worker.postMessage(task);
        });
    }

    return {compute, cancel};
})();
