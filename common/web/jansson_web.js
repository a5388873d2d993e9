/* What of jansson the readers of glTF and of a lab's folder call, by the browser's own JSON. A json_t is {type, refcount} in the module's
 * memory, never freed: the worker that reads a file ends, and a page has one lab. An iterator is the key's text. */
mergeInto(LibraryManager.library, {
    $Jansson__deps: ["malloc"],
    $Jansson: {
        make: function (value) {
            if (value === undefined)
                return 0;
            this.values = this.values || new Map();
            this.pointers = this.pointers || new Map();
            var kept = typeof value === "object" && value !== null;
            if (kept && this.pointers.has(value))
                return this.pointers.get(value);
            var pointer = _malloc(8);
            HEAP32[pointer >> 2] = Array.isArray(value) ? 1 : kept ? 0 : typeof value === "string" ? 2 :
                typeof value === "number" ? (Number.isInteger(value) && Math.abs(value) < 1e15 ? 3 : 4) : value === true ? 5 :
                value === false ? 6 : 7;
            HEAP32[pointer + 4 >> 2] = -1;
            this.values.set(pointer, value);
            if (kept)
                this.pointers.set(value, pointer);
            return pointer;
        },
        of: function (pointer) { return pointer ? this.values.get(pointer) : undefined; },
        list: function (pointer) {
            var value = this.of(pointer);
            return Array.isArray(value) ? value : [];
        },
        object: function (pointer) {
            var value = this.of(pointer);
            return value && typeof value === "object" && !Array.isArray(value) ? value : {};
        },
        member: function (value, key) { return Object.prototype.hasOwnProperty.call(value, key) ? value[key] : undefined; },
        text: function (value) {
            var size = lengthBytesUTF8(value) + 1, pointer = _malloc(size);
            stringToUTF8(value, pointer, size);
            return pointer;
        },
        key: function (object, number) {
            var keys = Object.keys(object);
            if (number >= keys.length)
                return 0;
            var pointer = this.text(keys[number]);
            this.keys = this.keys || new Map();
            this.keys.set(pointer, {object: object, number: number, value: object[keys[number]]});
            return pointer;
        },
    },
    json_loadb__deps: ["$Jansson"],
    json_loadb: function (bytes, size, flags, error) {
        var text = UTF8ToString(bytes, size);
        try {
            return Jansson.make(JSON.parse(text));
        } catch (failure) {
            var said = String(failure.message), at = /position (\d+)/.exec(said), place = /line (\d+) column (\d+)/.exec(said);
            var before = text.slice(0, at ? Number(at[1]) : text.length).split("\n");
            HEAP32[error >> 2] = place ? Number(place[1]) : before.length;
            HEAP32[error + 4 >> 2] = place ? Number(place[2]) : before[before.length - 1].length;
            stringToUTF8(said.replace(/^JSON.parse: /, "").split(" in JSON at")[0].replace(/[^ -~]/g, "?"), error + 92, 160);
            return 0;
        }
    },
    json_object_get__deps: ["$Jansson"],
    json_object_get: function (object, key) { return Jansson.make(Jansson.member(Jansson.object(object), UTF8ToString(key))); },
    json_object_size__deps: ["$Jansson"],
    json_object_size: function (object) { return Object.keys(Jansson.object(object)).length; },
    json_object_iter__deps: ["$Jansson"],
    json_object_iter: function (object) { return Jansson.key(Jansson.object(object), 0); },
    json_object_key_to_iter: function (key) { return key; },
    json_object_iter_key: function (iterator) { return iterator; },
    json_object_iter_value__deps: ["$Jansson"],
    json_object_iter_value: function (iterator) { return iterator ? Jansson.make(Jansson.keys.get(iterator).value) : 0; },
    json_object_iter_next__deps: ["$Jansson"],
    json_object_iter_next: function (object, iterator) {
        var at = Jansson.keys.get(iterator);
        return Jansson.key(at.object, at.number + 1);
    },
    json_array_size__deps: ["$Jansson"],
    json_array_size: function (list) { return Jansson.list(list).length; },
    json_array_get__deps: ["$Jansson"],
    json_array_get: function (list, index) { return Jansson.make(Jansson.list(list)[index >>> 0]); },
    json_array__deps: ["$Jansson"],
    json_array: function () { return Jansson.make([]); },
    json_array_append_new__deps: ["$Jansson"],
    json_array_append_new: function (list, value) { return Jansson.list(list).push(Jansson.of(value)), 0; },
    json_integer__deps: ["$Jansson"],
    json_integer: function (low, high) { return Jansson.make(high * 4294967296 + (low >>> 0)); },
    json_integer_value__deps: ["$Jansson"],
    json_integer_value: function (number) {
        var value = Number.isInteger(Jansson.of(number)) ? Jansson.of(number) : 0;
        setTempRet0(Math.floor(value / 4294967296) | 0);
        return value >>> 0 | 0;
    },
    json_real_value__deps: ["$Jansson"],
    json_real_value: function (number) { return Number(Jansson.of(number)) || 0; },
    json_number_value__deps: ["$Jansson"],
    json_number_value: function (number) { return Number(Jansson.of(number)) || 0; },
    json_string__deps: ["$Jansson"],
    json_string: function (text) { return Jansson.make(UTF8ToString(text)); },
    json_string_length__deps: ["$Jansson"],
    json_string_length: function (text) { return lengthBytesUTF8(String(Jansson.of(text))); },
    json_string_value__deps: ["$Jansson"],
    json_string_value: function (text) {
        var value = Jansson.of(text);
        Jansson.texts = Jansson.texts || new Map();
        if (typeof value === "string" && !Jansson.texts.has(text))
            Jansson.texts.set(text, Jansson.text(value));
        return Jansson.texts.get(text) || 0;
    },
    json_delete: function () {},
});
