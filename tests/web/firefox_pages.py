"""The pages in Firefox: they draw what they draw natively, and judge as `check` does."""
import json
import unittest

import firefox
from labs_pages import SHADERS, SOLUTION, OfLabs, check, mistakes, said
from model_pages import OfModels
from pages import RENDERER, differences, native, part

MISSING = firefox.missing()
SAYS_MEDIUMP = ("PointLightedCube_perFragment", "PointLightedSphere_perFragment")


@unittest.skipIf(MISSING, f"{MISSING}: not found")
class InFirefox(OfLabs, OfModels):
    @classmethod
    def start(cls):
        return firefox.Firefox()

    def tearDown(self):
        self.assertEqual(self.page.complaints(), [])
        super().tearDown()

    def of_page(self, name, link):
        """How many bytes of a page's picture are not the native ones, and how many are off by more than a step."""
        self.assertEqual(self.page.complaints(), [])  # of the page before
        self.open(name, link)
        return differences(self.shown(), native(name, ["--" + option for option in link.split("&")]))

    def test_every_program_draws_what_it_draws_natively(self):
        """On the same Mesa, where a comparison that fails says which renderer it was."""
        self.open("LightedCube")
        renderer = self.page.run(RENDERER)
        self.assertIn("llvmpipe", renderer)
        for program in part(self.programs()):
            with self.subTest(program["name"], renderer=renderer):
                self.assertEqual(self.of_page(program["name"], "time=1.3&precision=highp"), (0, 0))
        # Firefox makes desktop OpenGL of the shaders, which has no mediump: here it is highp, natively 11 bits. These are 0.50
        # and at most 0.96 steps from the exact colour (tests/README.md), so that bytes are at most one step apart.
        for name in SAYS_MEDIUMP:
            with self.subTest(name, renderer=renderer):
                self.assertEqual(self.of_page(name, "time=1.3")[1], 0)

    def test_models(self):
        self.assert_drawn("Scene", self.moving(), ("time=1.3", "camera=fit"))
        self.assert_drawn("ShadingModels", self.roof(), ("precision=highp",))

    def test_a_page_as_one_file(self):
        self.open("single/Shadows", "precision=highp")
        self.assertEqual(differences(self.shown(), native("Shadows", ["--precision=highp"])), (0, 0))

    def test_the_exact_picture_has_the_same_bits(self):
        self.open("LightedCube")
        self.assert_exact_bits(part(program["name"] for program in self.programs() if program["scene"]))

    def test_a_lost_context_comes_back(self):
        self.open("FourLights", "time=2")
        before = self.shown()
        self.page.run("Page.page.engine.module.canvas.getContext('webgl2').getExtension('WEBGL_lose_context').loseContext()")
        self.page.wait("document.getElementById('status').textContent.startsWith('Drawn again')")
        self.page.run("document.getElementById('forward').click(), document.getElementById('back').click()")
        self.settle()
        self.assertEqual(self.shown(), before)

    def test_a_pixel_of_the_book(self):
        """Both formulas of the chapter have its numbers."""
        self.open("chapter13")
        self.page.run("Book.book.figures[1].where.scrollIntoView()")
        self.page.wait("Book.book.figures[1].drawn")
        self.page.run("""(() => {
            const {canvas} = Book.book.figures[1], box = canvas.getBoundingClientRect();
            const at = {bubbles: true, clientX: box.left + 205.5 * box.width / canvas.width, clientY: box.top + 170.5 * box.height / canvas.height};
            canvas.dispatchEvent(new PointerEvent("pointerdown", at));
            canvas.dispatchEvent(new PointerEvent("pointerup", at));
            canvas.dispatchEvent(new MouseEvent("click", at));
        })()""")
        self.page.wait("document.querySelectorAll('[data-at]:not([hidden])').length === 2")
        self.assertIn("pixel 205, 170:", self.text("[data-at]"))

    def test_labs(self):
        for name in ("index", "labs", *mistakes.NAMES.values()):
            self.open(name)
            self.assertEqual(self.page.complaints(), [], name)
        self.open(mistakes.NAMES[5])
        for lab in part(SHADERS):
            with self.subTest(lab=lab):
                texts = mistakes.read(lab)
                self.assertEqual(said(self.judge(lab, texts)), said(check(lab, texts)))
        texts = {**SOLUTION, "lab05.frag": SOLUTION["lab05.frag"].replace("normalize(v_Normal)", "v_Normal")}
        self.page.run(f"Lab.lab.editor.texts = () => new Map(Object.entries({json.dumps(texts)}))")
        self.page.run("document.getElementById('check').click()")
        self.page.wait("!document.getElementById('check').disabled")
        self.assertIn("not normalized: v_Normal", self.text("#result"))
