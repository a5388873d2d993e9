/* jansson.h, by the browser's JSON. A value is its number in a list; what is at 0 is none. */
const json = {
    $values: [undefined],

    $kept__deps: ["$values"],
    $kept: function (x) { return x === undefined ? 0 : values.push(x) - 1; },

    /* In the heap, where it stays. */
    $toHeap: function (x) {
        if (typeof x !== "string")
            return 0;
        var size = lengthBytesUTF8(x) + 1, to = _malloc(size);
        stringToUTF8(x, to, size);
        return to;
    },

    json_loadb__deps: ["$kept"],
    json_loadb: function (text) {
        try {
            return kept(JSON.parse(UTF8ToString(text)));
        } catch (error) {
            return 0;
        }
    },
    json_pack__deps: ["$kept"],
    json_pack: function (format, text) { return kept([UTF8ToString(text)]); },
    json_decref: function (value) {},
    json_object_get__deps: ["$kept"],
    json_object_get: function (value, key) { return kept(new Map(Object.entries(values[value] || {})).get(UTF8ToString(key))); },
    json_array_get__deps: ["$kept"],
    json_array_get: function (value, i) { return kept((values[value] || [])[i]); },
    json_string_value__deps: ["$values", "$toHeap"],
    json_string_value: function (value) { return toHeap(values[value]); },
    json_object_key__deps: ["$values", "$toHeap"],
    json_object_key: function (value, before) {
        var keys = Object.keys(values[value] || {});
        return toHeap(keys[before ? keys.indexOf(UTF8ToString(before)) + 1 : 0]);
    },
};

const OF_ONE = {
    array_size: 'Object.keys(x || "").length',
    number_value: 'typeof x === "number" ? x : 0',
    is_object: '!!x && typeof x === "object" && !Array.isArray(x)',
    is_array: "Array.isArray(x)",
    is_string: 'typeof x === "string"',
    is_number: 'typeof x === "number"',
    is_integer: "Number.isInteger(x)",
    is_boolean: 'typeof x === "boolean"',
    is_true: "x === true",
};
for (const name of Object.keys(OF_ONE)) {
    json["json_" + name + "__deps"] = ["$values"];
    json["json_" + name] = new Function("value", "var x = values[value]; return +(" + OF_ONE[name] + ");");
}
mergeInto(LibraryManager.library, json);
