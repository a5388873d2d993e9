"use strict";
/* A form of a program's options, from the table that the module gives: names, ranges, choices and help are those of the
 * command line. */
const Controls = (() => {
    const LONGEST_RANGE = 1024; /* of a slider */

    function element(name, attributes = {}, ...children) {
        const made = document.createElement(name);
        for (const [key, value] of Object.entries(attributes))
            if (value !== false && value !== undefined)
                made.setAttribute(key, value === true ? "" : value);
        made.append(...children);
        return made;
    }

    const title = name => name[0].toUpperCase() + name.slice(1).replace(/-/g, " ");

    /* "R,G,B" of 0 to 1 as "#rrggbb". */
    function toHex(text) {
        const numbers = text.split(",").map(Number);
        const three = numbers.length === 1 ? [numbers[0], numbers[0], numbers[0]] : numbers;
        return "#" + three.map(x => Math.round(255 * Math.min(1, Math.max(0, x || 0))).toString(16).padStart(2, "0"))
            .join("");
    }

    const fromHex = hex => [1, 3, 5].map(i => +(parseInt(hex.slice(i, i + 2), 16) / 255).toFixed(4)).join(",");

    function choice(option, id, attributes) {
        const select = element("select", {id, ...attributes});
        if (option.kind === "text")
            select.append(element("option", {value: ""}, option.standard || "default"));
        select.append(...option.choices.map(name => element("option", {value: name}, name)));
        return {inputs: [select], read: () => select.value, show: text => { select.value = text; }};
    }

    function flag(option, id, attributes) {
        const box = element("input", {type: "checkbox", id, ...attributes});
        return {inputs: [box], read: () => box.checked, show: text => { box.checked = text === true; }};
    }

    /* A number, and a slider where the range is short. */
    function number(option, id, attributes) {
        const step = option.kind === "whole" ? 1 : "any";
        const limits = "min" in option ? {min: option.min, max: option.max} : {};
        const field = element("input", {type: "number", id, step, inputmode: "decimal", ...limits, ...attributes});
        const inputs = [field];
        if ("min" in option && option.max - option.min <= LONGEST_RANGE) {
            const fine = option.kind === "whole" ? 1 : (option.max - option.min) / 200;
            const slider = element("input", {type: "range", ...limits, step: fine, "aria-label": title(option.name) +
                ", slider"});
            slider.addEventListener("input", () => { field.value = slider.value; });
            field.addEventListener("input", () => { slider.value = field.value; });
            inputs.push(slider);
        }
        return {inputs, read: () => field.value, show: text => inputs.forEach(input => { input.value = text; })};
    }

    function color(option, id, attributes) {
        const field = element("input", {type: "text", id, size: 12, ...attributes});
        const picker = element("input", {type: "color", "aria-label": title(option.name) + ", chosen"});
        picker.addEventListener("input", () => { field.value = fromHex(picker.value); });
        return {inputs: [field, picker], read: () => field.value,
                show: text => { field.value = text; picker.value = toHex(text); }};
    }

    function text(option, id, attributes) {
        const field = element("input", {type: "text", id, placeholder: option.standard || option.placeholder,
                                        ...attributes});
        return {inputs: [field], read: () => field.value, show: value => { field.value = value; }};
    }

    function kind(option) {
        if (option.kind === "flag")
            return flag;
        if (option.choices.length)
            return choice;
        return {number, whole: number, color: option.placeholder ? text : color}[option.kind] || text;
    }

    /* A download. Some browsers read the blob after the click. */
    function save(name, blob) {
        const link = element("a", {download: name, href: URL.createObjectURL(blob)});
        link.click();
        setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    }

    function paint(canvas, picture) {
        if (canvas.width !== picture.width || canvas.height !== picture.height) {
            canvas.width = picture.width;
            canvas.height = picture.height;
        }
        canvas.getContext("2d").putImageData(picture, 0, 0);
    }

    /* A browser opens a dropped file in place of the page, with the texts in it; say(name) instead. */
    function refuseFiles(say) {
        for (const kind of ["dragover", "drop"])
            window.addEventListener(kind, event => {
                if (!event.dataTransfer.types.includes("Files"))
                    return;
                event.preventDefault();
                const [file] = event.dataTransfer.files;
                if (kind === "drop")
                    say(file ? file.name.replace(/\p{Cc}/gu, " ").slice(0, 100) : "a file");
            });
    }

    /* Adds an option to `parent`, and returns its control. */
    function put(parent, option, id, change) {
        const control = kind(option)(option, id, {"aria-describedby": id + "-help"});
        const range = option.range ? " (" + option.range + ")" : "";
        parent.append(element("div", {class: "option"},
                              element("label", {for: id}, title(option.name)),
                              element("span", {class: "inputs"}, ...control.inputs),
                              element("small", {id: id + "-help"}, (option.help || "") + range)));
        for (const input of control.inputs)
            input.addEventListener("input", () => change(option.name, control.read()));
        return control;
    }

    const MATERIAL = /^(back-)?material$|^(ambient|diffuse|specular|emission|shininess|opacity)$/;
    const LIGHTS = new RegExp("light|^(global-ambient|red|green|blue|viewpoint|ambient|directional|point|spot|cutoff|exponent|ambient-cone|" +
                              "constant|linear|quadratic|rotating)$|^(fixed|turning)-");
    const COMPUTED = /^(reflection|interpolation|viewer|two-sided|front-face|matrix|fit|gain)$/;
    const ALL = "Of all programs";

    /* A switch is not a reflectivity. */
    function heading({name, own, choices}) {
        return !own ? ALL : MATERIAL.test(name) && (!choices.length || name.endsWith("material")) ? "Material" :
            LIGHTS.test(name) ? "Light" : COMPUTED.test(name) ? "How it is computed" : "Of this program";
    }

    /* Fills `form`; change(name, value) is called for each change by the user. */
    function fill(form, options, change) {
        const shown = new Map();
        for (const title of ["Of this program", "Material", "Light", "How it is computed", ALL]) {
            const group = options.filter(option => heading(option) === title && option.name !== "time");
            if (!group.length)
                continue;
            const folded = title === ALL && group.length < options.length - 1;
            const set = folded ? element("details", {}, element("summary", {}, title)) :
                element("fieldset", {}, element("legend", {}, title));
            for (const option of group)
                shown.set(option.name, put(set, option, "option-" + option.name, change));
            form.append(set);
        }
        return {
            /* The values as they are; what is being typed stays. */
            show(values) {
                for (const [name, control] of shown)
                    if (!control.inputs.includes(document.activeElement))
                        control.show(values[name] === undefined ? "" : values[name]);
            },
            /* The option that a message begins with, if any. */
            blame(message) {
                for (const [name, control] of shown)
                    control.inputs[0].setAttribute("aria-invalid", message.startsWith("--" + name + " ") ||
                                                                   message.startsWith("--" + name + ":"));
            },
        };
    }

    return {element, title, save, paint, refuseFiles, put, fill};
})();
