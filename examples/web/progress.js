"use strict";
/* The last verdict on each lab, kept on this device, if it lets us. */
const Progress = (() => {
    const KEY = "lighting labs";

    function all() {
        try {
            const kept = JSON.parse(localStorage.getItem(KEY) || "{}");
            return kept && typeof kept === "object" ? kept : {};
        } catch {
            return {};
        }
    }

    function of(lab) {
        const {verdict, points, most} = Object.hasOwn(all(), lab) ? all()[lab] || {} : {};
        return typeof verdict === "string" && Number.isFinite(points) ? {verdict, points, most} : {};
    }

    function keep(lab, {verdict, points, most}) {
        try {
            localStorage.setItem(KEY, JSON.stringify({...all(), [lab]: {verdict, points, most}}));
        } catch { /* then it is not kept */ }
    }

    return {of, keep};
})();
