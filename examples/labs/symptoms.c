#include "symptoms.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Of the pixels inside the objects, in all scenes; in steps. */
typedef struct Overview {
    double pixels, bright_pixels;
    double dark, bright; /* drawn less exact, of the darker and the brighter pixels */
    double channels[3];  /* absolute */
    bool anything;       /* is drawn at all */
    bool wrong[PROBE_KIND_COUNT];
} Overview;

static void look_at(const Shot *shot, const Reference *exact, Overview *overview)
{
    const unsigned char *drawn = shot->image.pixels;
    for (size_t i = 0; i < (size_t)exact->width * (size_t)exact->height; i++) {
        double mean = 0, apart = 0;
        overview->anything |= drawn[4 * i] || drawn[4 * i + 1] || drawn[4 * i + 2];
        if (!exact->interior[i])
            continue;
        for (size_t c = 0; c < 3; c++) {
            const double right = 255 * (double)exact->color[3 * i + c];
            mean += right / 3;
            apart += (drawn[4 * i + c] - right) / 3;
            overview->channels[c] += fabs(drawn[4 * i + c] - right);
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

static void name_scenes(const Overview *overview, Verdict *verdict)
{
    static const char *const HINTS[PROBE_KIND_COUNT] = {
        [PROBE_MOVED] = "It is wrong only where the object is turned, moved or stretched.",
        [PROBE_COARSE] = "It is wrong only on a coarse mesh.",
        [PROBE_BEHIND] = "It is wrong only where the light is behind the object.",
        [PROBE_CROWD] = "It is wrong only where there are several objects.",
        [PROBE_WIDE] = "It is wrong only where the picture is wide and the light near.",
    };
    int count = 0, last = 0;
    for (int i = 0; i < PROBE_KIND_COUNT; i++) {
        count += overview->wrong[i];
        last = overview->wrong[i] ? i : last;
    }
    if (count == 1 && HINTS[last])
        verdict_add_symptom(verdict, "%s", HINTS[last]);
}

static void compare_sides(const Overview *overview, Verdict *verdict)
{
    const double dark_pixels = fmax(overview->pixels - overview->bright_pixels, 1);
    const double dark = overview->dark / dark_pixels;
    const double bright = overview->bright / fmax(overview->bright_pixels, 1);
    if (fabs(bright) >= 1)
        verdict_add_symptom(verdict, "Lit parts are too %s, by %.0f steps of 255 on average.",
                            bright < 0 ? "dark" : "bright", fabs(bright));
    if (fabs(dark) >= 1)
        verdict_add_symptom(verdict, "Dark parts are too %s, by %.0f steps of 255 on average.",
                            dark < 0 ? "dark" : "bright", fabs(dark));
    if (fabs(bright) < 1 && fabs(dark) < 1 && overview->pixels > 0)
        verdict_add_symptom(verdict, "It is as bright as it should be on average, but light and "
                                     "shade lie elsewhere.");
}

static void compare_channels(const Overview *overview, Verdict *verdict)
{
    static const char *const NAMES[] = {"red", "green", "blue"};
    const double *c = overview->channels, sum = c[0] + c[1] + c[2];
    for (int i = 0; i < 3 && sum > 0; i++)
        if (c[i] > 0.75 * sum)
            verdict_add_symptom(verdict, "Most of the error is in the %s channel.", NAMES[i]);
}

void symptoms_describe(const Shots *shots, bool moved, Verdict *verdict)
{
    Overview overview = {.pixels = 0};
    for (int i = 0; i < shots->count; i++) {
        const Shot *shot = &shots->shots[i];
        look_at(shot, &shot->truths[shots->truth], &overview);
        overview.wrong[shot->probe.kind] |= !verdict->probes[i].passed;
    }
    if (!overview.anything) {
        verdict_add_symptom(verdict,
                            "Nothing is drawn, or all of it black: see whether gl_Position "
                            "is set to u_MvpMatrix * a_Position, and gl_FragColor to a "
                            "colour.");
        return;
    }
    if (moved)
        verdict_add_symptom(verdict,
                            "The outline is not where it should be: the fault is in the position, "
                            "not in the light alone.");
    else
        verdict_add_symptom(verdict, "The outline is right: the fault is in the light.");
    name_scenes(&overview, verdict);
    compare_sides(&overview, verdict);
    compare_channels(&overview, verdict);
}
