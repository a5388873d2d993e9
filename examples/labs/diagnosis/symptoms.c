/* What can be said without a name: sums over the pixels inside objects. Errors in lit and in unlit
 * parts point to different terms of the sum; the worst pixel has its two colours, for those who
 * want to calculate. */
#include "labs/diagnosis/diagnose.h"

#include <math.h>

/* Sums over the pixels inside the objects in all scenes, in steps of 1/255. */
typedef struct Overview {
    double pixels, bright_pixels;
    double dark, bright; /* drawn minus exact, of dark and of bright pixels */
    bool anything;       /* any pixel is not black */
} Overview;

static void look_at(const LabPicture *picture, const Reference *exact, Overview *overview)
{
    const unsigned char *drawn = picture->image.pixels;
    for (size_t i = 0; i < (size_t)exact->width * (size_t)exact->height; i++) {
        double mean = 0, apart = 0;
        overview->anything |= drawn[4 * i] || drawn[4 * i + 1] || drawn[4 * i + 2];
        if (!exact->interior[i])
            continue;
        for (size_t c = 0; c < 3; c++) {
            const double right = 255 * (double)exact->color[3 * i + c];
            mean += right / 3;
            apart += (drawn[4 * i + c] - right) / 3;
        }
        overview->pixels++;
        if (mean > 60) {
            overview->bright_pixels++;
            overview->bright += apart;
        } else {
            overview->dark += apart;
        }
    }
}

static void compare_sides(const Overview *overview, Verdict *verdict)
{
    const double dark_pixels = fmax(overview->pixels - overview->bright_pixels, 1);
    const double dark = overview->dark / dark_pixels;
    const double bright = overview->bright / fmax(overview->bright_pixels, 1);
    if (fabs(bright) >= 1)
        verdict_add_symptom(verdict, "Lit parts are too %s, by %.0f of 255 steps on average.",
                            bright < 0 ? "dark" : "bright", fabs(bright));
    if (fabs(dark) >= 1)
        verdict_add_symptom(verdict, "Dark parts are too %s, by %.0f of 255 steps on average.",
                            dark < 0 ? "dark" : "bright", fabs(dark));
    if (fabs(bright) < 1 && fabs(dark) < 1 && overview->pixels > 0)
        verdict_add_symptom(verdict,
                            "The average brightness is right, but single places are too bright or "
                            "too dark.");
}

/* The pixel with the largest error, in the worst scene. */
static void point_at_worst(const LabPictures *pictures, Verdict *verdict)
{
    int worst = -1;
    for (int i = 0; i < pictures->count && i < verdict->probe_count; i++)
        if (!verdict->probes[i].passed &&
            (worst < 0 || verdict->probes[i].rms > verdict->probes[worst].rms))
            worst = i;
    if (worst < 0)
        return;
    const LabPicture *picture = &pictures->items[worst];
    const Reference *exact = &picture->truths[pictures->truth];
    const unsigned char *drawn = picture->image.pixels;
    double most = 0;
    size_t at = 0;
    for (size_t i = 0; i < (size_t)exact->width * (size_t)exact->height; i++) {
        for (size_t c = 0; c < 3 && exact->interior[i]; c++) {
            const double apart = fabs(drawn[4 * i + c] - 255 * (double)exact->color[3 * i + c]);
            if (apart > most)
                most = apart, at = i;
        }
    }
    if (most > 0)
        verdict_add_symptom(
            verdict,
            "Scene %s (%s), column %d, row %d from the top: it is (%d, %d, %d), right is (%.0f, "
            "%.0f, %.0f).",
            LAB_SCENE_NAMES[picture->lab_scene.kind], picture->lab_scene.known ? "known" : "seed",
            (int)(at % (size_t)exact->width), (int)(at / (size_t)exact->width), drawn[4 * at],
            drawn[4 * at + 1], drawn[4 * at + 2], 255 * (double)exact->color[3 * at],
            255 * (double)exact->color[3 * at + 1], 255 * (double)exact->color[3 * at + 2]);
}

void symptoms_describe(const LabPictures *pictures, bool moved, Verdict *verdict)
{
    Overview overview = {.pixels = 0};
    for (int i = 0; i < pictures->count; i++) {
        const LabPicture *picture = &pictures->items[i];
        look_at(picture, &picture->truths[pictures->truth], &overview);
    }
    if (!overview.anything) {
        verdict_add_symptom(verdict, "Nothing is drawn, or everything is black: check that "
                                     "gl_Position is u_MvpMatrix * a_Position and gl_FragColor a "
                                     "colour.");
        return;
    }
    /* In lab 10 the mesh and its outline are the student's. */
    const bool budget = pictures->lab->budget;
    if (moved || !budget)
        verdict_add_symptom(verdict, "%s",
                            !moved ? "The outline is right: the mistake is in the light."
                            : pictures->lab->given
                                ? "The outline is wrong: check the model matrix first."
                                : "The outline is wrong: check gl_Position first.");
    compare_sides(&overview, verdict);
    point_at_worst(pictures, verdict);
}
