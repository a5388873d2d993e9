"use strict";
/* Two pictures over each other: the upper one is seen left of a slider's thumb. */
const Wipe = (() => {
    function show(slider, upper) {
        upper.style.clipPath = "inset(0 " + (100 - slider.value) + "% 0 0)";
    }

    return {show};
})();
