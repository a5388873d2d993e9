#include "study/measure/survey.h"

#include "base/clock.h"
#include "base/memory.h"
#include "scene/material.h"
#include "study/measure/scenes.h"
#include "study/results/table.h"

#include <math.h>
#include <stdlib.h>

enum { PHONG, BLINN_PHONG, FITTED, MODELS };

static const char *const NAMES[MODELS] = {"Phong", "Blinn-Phong", "Blinn-Phong, fitted"};

/* Up to a quarter of 128, OpenGL 1.1's maximum: the fitted exponent is about four times as large.
 */
static const double SHININESSES[] = {4, 8, 16, 30};

enum { SHININESS_COUNT = sizeof SHININESSES / sizeof SHININESSES[0], ROUNDS = 15 };

typedef struct Model {
    double shininess;
    StudyScene made;
    Reference exact;
    SettingPicture drawing;
    ResultRow found;                 /* of the drawn picture, from its own exact one */
    double apart_rms, apart_maximum; /* of the exact picture from Phong's exact one, inside */
    double milliseconds[ROUNDS];
} Model;

static bool open_model(Survey *survey, Model *model, int number, double shininess, Message *message)
{
    const Quality usual = quality_usual();
    model->shininess = number == FITTED ? material_fitted_shininess(shininess) : shininess;
    study_shiny(&model->made, model->shininess,
                number == PHONG ? REFLECTION_PHONG : REFLECTION_BLINN_PHONG);
    if (!survey_exact(survey, &model->made.scene, &model->exact, message) ||
        !setting_picture_open(&model->drawing, survey->renderer, &model->made.scene, &usual,
                              message) ||
        !setting_picture_counts(&model->drawing, survey->renderer, &model->found, message))
        return false;
    setting_picture_error(&model->drawing, &model->exact, &model->found);
    return true;
}

static void compare(Model *model, const Reference *phong)
{
    double squares = 0;
    long count = 0;
    for (size_t i = 0; i < (size_t)phong->width * (size_t)phong->height; i++) {
        if (!phong->interior[i] || !model->exact.interior[i])
            continue;
        count += 3;
        for (size_t c = 3 * i; c < 3 * i + 3; c++) {
            const double apart =
                255 * fabs((double)model->exact.color[c] - (double)phong->color[c]);
            squares += apart * apart;
            model->apart_maximum = fmax(model->apart_maximum, apart);
        }
    }
    model->apart_rms = count ? sqrt(squares / (double)count) : NAN;
}

static bool measure(Survey *survey, Model models[MODELS], Message *message)
{
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < MODELS; i++) {
            SettingPicture *drawing = &models[(i + round) % MODELS].drawing;
            double *milliseconds = &models[(i + round) % MODELS].milliseconds[round];
            double wall, gpu;
            if (!setting_picture_frame(drawing, survey->renderer, &wall, &gpu, message) ||
                !setting_picture_frame(drawing, survey->renderer, &wall, &gpu, message))
                return false;
            *milliseconds = 1e3 * wall;
        }
    return true;
}

static void print_models(const Model models[MODELS], double phong, Table *table)
{
    for (int i = 0; i < MODELS; i++) {
        const Model *model = &models[i];
        double ratios[ROUNDS], times[ROUNDS];
        for (int k = 0; k < ROUNDS; k++) {
            times[k] = model->milliseconds[k];
            ratios[k] = times[k] / models[PHONG].milliseconds[k];
        }
        table_row(table, "%s|%g|%.1f|%.2f|%.3f|%.2f|%.3f|%.3f|%.2f [%.2f, %.2f]|%d", NAMES[i],
                  phong, model->shininess, model->found.interior_maximum, model->found.interior_rms,
                  model->apart_maximum, model->apart_rms, clock_median(times, ROUNDS),
                  clock_median(ratios, ROUNDS), clock_quantile(ratios, ROUNDS, 0.25),
                  clock_quantile(ratios, ROUNDS, 0.75), model->found.fragment_operations);
    }
}

static void widen(double range[2], double value)
{
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

static bool report_shininess(Survey *survey, double shininess, Table *table, ModelsApart *apart,
                             Message *message)
{
    Model *models = memory_new(MODELS, sizeof *models);
    bool done = true;
    for (int i = 0; i < MODELS && done; i++)
        done = open_model(survey, &models[i], i, shininess, message);
    for (int i = 0; i < MODELS && done; i++)
        compare(&models[i], &models[PHONG].exact);
    done = done && measure(survey, models, message);
    if (done) {
        widen(apart->same, models[BLINN_PHONG].apart_maximum);
        widen(apart->fitted, models[FITTED].apart_maximum);
        print_models(models, shininess, table);
    }
    for (int i = 0; i < MODELS; i++) {
        setting_picture_close(&models[i].drawing);
        reference_close(&models[i].exact);
    }
    setting_renderer_forget(survey->renderer);
    free(models);
    return done;
}

bool models_report(Survey *survey, bool markdown, FILE *file, ModelsApart *apart, Message *message)
{
    *apart = (ModelsApart){{INFINITY, 0}, {INFINITY, 0}};
    bool done = true;
    char with[RESULT_WITH_SIZE];
    results_measured_with(&survey->like, with);
    Table table;
    table_open(&table, "model|s|shininess|error|rms|from Phong|rms|ms|over Phong|operations");
    for (int i = 0; i < SHININESS_COUNT && done; i++)
        done = report_shininess(survey, SHININESSES[i], &table, apart, message);
    fprintf(file,
            "\nPhong and Blinn-Phong on a sphere, fitted to Phong's shininess s: the error of each "
            "against its own exact picture,\nand the distance of its exact picture from Phong's "
            "(steps of 1/255, interior)\n%s\n\n",
            with);
    table_close(&table, markdown, file);
    return done;
}
