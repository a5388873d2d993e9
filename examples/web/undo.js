"use strict";
/* Steps that can be undone: of each the state's parts that it changed, as they were before. What follows of one kind within a
 * second is one step. */
const Undo = (() => {
    const TOGETHER = 1000; /* ms */
    const MOST = 200;
    const NATIVE = "textarea, [type=text], [type=number]"; /* undo what is typed in them by themselves */
    const ALL = "all options"; /* are several steps, however fast */
    const text = value => JSON.stringify(value instanceof Map ? [...value] : value);

    /* `state()` is an object, of which `apply` takes a part; `say(message)`. */
    function open(state, apply, say) {
        let done = [], undone = [];

        function remember(kind, before) {
            const after = state(), step = {}, now = performance.now();
            for (const name of Object.keys(before).filter(name => text(before[name]) !== text(after[name])))
                step[name] = before[name];
            if (!Object.keys(step).length)
                return;
            const last = done[done.length - 1];
            undone = [];
            if (last && last.kind === kind && kind !== ALL && now - last.at < TOGETHER)
                Object.assign(last, {at: now, step: {...step, ...last.step}});
            else
                done = [...done, {kind, at: now, step}].slice(-MOST);
        }

        function move(from, to, word) {
            const one = from.pop();
            if (!one)
                return say("Nothing to " + word + ".");
            const now = state();
            to.push({...one, at: 0, step: Object.fromEntries(Object.keys(one.step).map(name => [name, now[name]]))});
            apply(one.step);
            say((word === "undo" ? "Undone: " : "Done again: ") + one.kind + ".");
        }

        const undo = () => move(done, undone, "undo"), redo = () => move(undone, done, "redo");
        window.addEventListener("keydown", event => {
            const key = event.key.toLowerCase();
            if (!(event.ctrlKey || event.metaKey) || event.altKey || !["z", "y"].includes(key) || event.target.matches(NATIVE))
                return;
            event.preventDefault();
            (key === "y" || event.shiftKey ? redo : undo)();
        });
        return {remember, undo, redo, clear() { done = undone = []; }};
    }

    return {open, ALL};
})();
