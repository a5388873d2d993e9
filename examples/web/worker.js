"use strict";
/* The exact picture takes a second or more: it is computed in a worker, which has the module and a canvas of its own. A
 * worker from a file is not allowed without a server, one from a text is. */
const ErrorWorker = (() => {
    let worker = null;

    function work() {
        self.onmessage = async ({data}) => {
            try {
                const engine = await Engine.open(data.compiled, new OffscreenCanvas(1, 1));
                const drawn = engine.replace(data.texts) && engine.run(data.lines) === 0 &&
                              engine.draw(data.seconds, data.orbit);
                const error = drawn && engine.json("error");
                self.postMessage(error ? {error, map: engine.picture()} : {message: engine.message});
            } catch (error) {
                self.postMessage({message: String(error)});
            }
        };
    }

    function cancel() {
        if (worker)
            worker.terminate();
        worker = null;
    }

    /* {error, map} or {message}. One that is being computed is abandoned. */
    function compute(task) {
        cancel();
        return new Promise(resolve => {
            const text = ['"use strict";', lightingFactory, Engine, "(" + work + ")();"].join("\n");
            const address = URL.createObjectURL(new Blob([text], {type: "text/javascript"}));
            worker = new Worker(address);
            worker.onmessage = ({data}) => { cancel(); resolve(data); };
            worker.onerror = event => { cancel(); resolve({message: event.message || "this browser starts no worker"}); };
            worker.postMessage(task);
            URL.revokeObjectURL(address);
        });
    }

    return {compute, cancel};
})();
