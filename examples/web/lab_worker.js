"use strict";
/* A lab in a worker: a student's shaders may take long or for ever, and then it is the worker that is ended, not the page. */
const LabWorker = (() => {
    /* So many times the time of a drawing: a check draws all scenes, and those of many mistakes. */
    const CHECKS = 5;
    const HANGS = "No answer: look for an endless loop. Your text is kept. If nothing is drawn after the next " +
                  "change, reload the page.";
    let worker = null, current = null, waiting = [];
    let drawn = null, judged = null; /* promises of {module, compiled}: at first, and from the first check on */
    let used = null; /* the worker's */

    function work() {
        let engine = null;
        const number = (name, ...values) => engine.module.ccall("page_" + name, "number", values.map(() => "number"), values);

        /* Each picture of {drawn, expected, difference}. */
        function draw({seconds, exact}) {
            if (number("draw", seconds) !== 1)
                throw engine.message;
            const answer = {drawn: engine.picture()};
            if (!exact)
                return answer;
            if (number("expected", seconds) !== 1)
                throw engine.message;
            answer.expected = engine.picture();
            answer.largest = number("difference");
            answer.difference = engine.picture();
            return answer;
        }

        function check({seed}) {
            const text = engine.module.ccall("page_check", "string", ["number"], [seed]);
            if (!text)
                throw engine.message;
            const verdict = JSON.parse(text);
            return {verdict, sheet: number("width") ? engine.picture() : null};
        }

        self.onmessage = async ({data}) => {
            try {
                if (!engine) {
                    engine = await Engine.open(data.compiled, new OffscreenCanvas(1, 1));
                    engine.module.canvas.addEventListener("webglcontextlost", () => self.postMessage({lost: true}));
                }
                if (data.what === "lose")
                    return engine.module.canvas.getContext("webgl2").getExtension("WEBGL_lose_context").loseContext();
                if (data.own && !engine.own)
                    engine.own = Object.entries(data.own).every(([name, text]) => engine.putLab(data.lab + "/" + name, text));
                if (engine.run([data.lab]) !== 0 || !engine.replace(data.texts))
                    throw engine.message;
                self.postMessage(data.what === "check" ? check(data) : draw(data));
            } catch (error) {
                if (typeof error !== "string") /* the module's state is unknown */
                    engine = null;
                self.postMessage({message: String(error)});
            }
        };
    }

    function start() {
        worker = startWorker(work, used.module);
        worker.onmessage = ({data}) => data.lost ? again() : finish(data);
        worker.onerror = event => end(event.message || "this browser starts no worker");
    }

    function finish(answer) {
        if (!current)
            return;
        const {resolve, timer} = current;
        clearTimeout(timer);
        current = null;
        resolve(answer);
        if (waiting.length)
            post(waiting.shift());
    }

    /* The next task gets another worker. */
    function end(message) {
        worker.terminate();
        worker = null;
        finish({message});
    }

    /* After a lost context another worker does it once more. */
    function again() {
        const job = current;
        if (job && job.lost)
            return end("The graphics context was lost.");
        worker.terminate();
        worker = current = null;
        if (!job)
            return api.lost();
        clearTimeout(job.timer);
        job.lost = true;
        post(job);
    }

    function post(job) {
        current = job;
        if (worker && used !== job.by) {
            worker.terminate();
            worker = null;
        }
        used = job.by;
        if (!worker)
            start();
        job.timer = setTimeout(() => end(HANGS), api.limit * (job.task.what === "check" ? CHECKS : 1));
        worker.postMessage({...job.task, compiled: used.compiled});
    }

    const compile = async module => ({module, compiled: await compileLighting(module)});

    /* What judges is loaded with the first check, and draws from then on. */
    function load(what) {
        drawn ||= compile(programModule());
        if (what === "check")
            judged ||= Point.load().then(() => compile(PROBE)).catch(error => { judged = null; throw error; });
        return judged || drawn;
    }

    /* {what: "draw" or "check", ...}. One task at a time; of those of a kind that wait the last is done,
     * and the others are answered by null. */
    async function ask(task) {
        let by;
        try {
            by = await load(task.what);
        } catch (error) {
            return {message: String(error)};
        }
        return new Promise(resolve => {
            const job = {task, by, resolve};
            if (!current)
                return post(job);
            waiting.filter(other => other.task.what === task.what).forEach(other => other.resolve(null));
            waiting = [...waiting.filter(other => other.task.what !== task.what), job];
        });
    }

    const api = {
        ask,
        limit: 60000, /* ms; drawing takes much less than a second, even by a slow renderer on a busy machine */
        lost() {},    /* called when a context is lost that nothing was being drawn with */
        lose() { worker.postMessage({what: "lose"}); }, /* for tests */
    };
    return api;
})();
