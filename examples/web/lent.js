"use strict";
/* Shader texts that come with a link. Whoever made the link wrote them, so they are shown, and drawn only when the reader says
 * so. They and what is changed in them stay in the link; the reader's own texts, which the device keeps, are untouched. */
const Lent = (() => {
    const part = id => document.getElementById(id);
    const lent = {packed: "", shown: "", editor: null, page: null};

    function tell(drawn) {
        part("lent").hidden = !lent.shown;
        part("draw-it").hidden = drawn;
        part("lent-said").textContent = !lent.shown ? "" : (drawn ? "Drawn with the text that came with this link" :
            "This link brings a text of " + [...lent.editor.changed().keys()].join(", ")) +
            ". It is neither yours nor the course's: whoever made the link wrote it. " +
            (drawn ? "What you change in it stays in the link." : "Read it in the editor; it is not drawn before you say so.") +
            " Your own texts are kept.";
    }

    /* To the reader's own texts; as after opening, the course's are drawn. */
    function leave() {
        lent.packed = lent.shown = "";
        lent.editor.borrow(null);
        lent.page.draw(new Map());
        tell(false);
    }

    /* The texts of lent.packed. */
    async function show() {
        if (lent.packed === lent.shown)
            return;
        if (!lent.packed)
            return leave();
        const packed = lent.packed;
        try {
            const texts = await Link.unpack(packed), strange = lent.editor.strange(texts);
            if (strange)
                throw "link: " + strange.slice(0, 80) + ": this page has no such shader file";
            if (packed !== lent.packed)
                return;
            lent.shown = ""; /* what is drawn next is the course's */
            lent.page.draw(new Map());
            lent.shown = packed;
            lent.editor.borrow(texts);
            tell(false);
        } catch (error) {
            lent.packed = lent.shown;
            lent.page.note();
            lent.page.fail(String(error));
        }
    }

    /* After the editor's texts are drawn: the link has them. */
    async function drawn() {
        if (!lent.shown)
            return;
        if (!lent.editor.changed().size)
            return leave();
        tell(true);
        try {
            lent.packed = lent.shown = await Link.pack(lent.editor.changed());
            lent.page.note();
        } catch (error) {
            lent.page.fail(String(error));
        }
    }

    function keep() {
        if (!lent.editor.own())
            return;
        lent.packed = lent.shown = "";
        lent.page.note();
        tell(false);
    }

    /* page: {draw(texts), note(), fail(message)}. */
    function open(editor, page) {
        Object.assign(lent, {editor, page});
        part("draw-it").addEventListener("click", editor.run);
        part("keep-it").addEventListener("click", keep);
        part("leave-it").addEventListener("click", leave);
        return show();
    }

    return {lent, open, show, drawn};
})();
