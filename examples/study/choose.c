#include "choose.h"

#include "efficient.h"
#include "front.h"
#include "scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void say(const char *what, const ResultRow *row, ErrorKind kind)
{
    char text[SETTING_TEXT_SIZE];
    setting_text(&row->setting, text);
    /* Rounded up, so that it serves as a budget. */
    printf("%s: %s\n  %s error %.3f steps of 1/255, %.3f ms [%.3f, %.3f]\n", what, text,
           kind == ERROR_INTERIOR_RMS ? "rms" : "largest", ceil(1e3 * row_error(row, kind)) / 1e3,
           row->time, row->time_lower, row->time_upper);
}

static ErrorKind kind_of(bool rms)
{
    return rms ? ERROR_INTERIOR_RMS : ERROR_INTERIOR_MAXIMUM;
}

static int place_of(const Front *front, const ResultRow *row)
{
    int place = 0;
    while (front->rows[place] != row)
        place++;
    return place;
}

static void say_measured_with(const Survey *survey)
{
    char with[RESULT_WITH_SIZE];
    results_measured_with(&survey->like, with);
    printf("measured with %s\n", with);
}

bool choose_by_error(Survey *survey, int scene, double error, bool rms, Message *message)
{
    const ErrorKind kind = kind_of(rms);
    const char *name = STUDY_SCENES[scene].name;
    ResultRow again;
    Front front;
    if (!front_open(&front, &survey->results, name, kind, message))
        return false;
    const ResultRow *chosen = front_cheapest(&front, kind, error);
    bool done = chosen != NULL;
    if (!chosen && front.count == 0)
        message_set(message, "%s: no setting has been measured", name);
    else if (!chosen)
        message_set(message, "--budget %g: no setting of %s is so exact; the best has %.3f", error,
                    name, row_error(front.rows[front.count - 1], kind));
    if (done) {
        say("cheapest", chosen, kind);
        done = survey_once(survey, scene, &chosen->setting, &again, message);
    }
    if (done) {
        const int place = place_of(&front, chosen);
        say("confirmed", &again, kind);
        if (place > 0)
            say("the next cheaper", front.rows[place - 1], kind);
        else
            printf("there is none that is cheaper\n");
        say_measured_with(survey);
        if (row_error(&again, kind) > error)
            done = message_set(message, "measured again, the error is %.3f, over the budget of %g",
                               row_error(&again, kind), error);
    }
    front_close(&front);
    return done;
}

bool choose_by_time(Survey *survey, int scene, double milliseconds, bool rms, Message *message)
{
    const ErrorKind kind = kind_of(rms);
    const char *name = STUDY_SCENES[scene].name;
    ResultRow again;
    Front front;
    if (!front_open(&front, &survey->results, name, kind, message))
        return false;
    const ResultRow *chosen = front_most_exact(&front, milliseconds);
    bool done = chosen != NULL;
    if (!chosen && front.count == 0)
        message_set(message, "%s: no setting has been measured", name);
    else if (!chosen)
        message_set(message,
                    "--time-budget %g: no setting of %s is so fast; the best takes %.3f ms",
                    milliseconds, name, front.rows[0]->time);
    if (done) {
        say("most exact", chosen, kind);
        done = survey_once(survey, scene, &chosen->setting, &again, message);
    }
    if (done) {
        const int place = place_of(&front, chosen);
        say("confirmed", &again, kind);
        if (place + 1 < front.count)
            say("the next slower", front.rows[place + 1], kind);
        else
            printf("there is none that is more exact\n");
        if (again.time > milliseconds * (1 + again.noise))
            printf("measured again it took longer than %g ms, by more than the noise (%.0f%%)\n",
                   milliseconds, 100 * again.noise);
        say_measured_with(survey);
    }
    front_close(&front);
    return done;
}

/* Calibration. */

static SceneClass class_of(int number)
{
    StudyScene made;
    study_scene(number, &made);
    return scene_class(&made.scene);
}

/* A setting's row for a class: the largest errors and the mean times of all scenes of the class.
 * False where one of them lacks it, or does not know them. */
static bool merge(const Results *results, SceneClass class, const Setting *setting, ResultRow *row)
{
    int scenes = 0;
    for (int i = 0; i < STUDY_SCENE_COUNT; i++) {
        if (class_of(i) != class)
            continue;
        const ResultRow *one = results_find(results, STUDY_SCENES[i].name, setting);
        if (!one || !isfinite(one->interior_maximum) || !isfinite(one->time))
            return false;
        if (scenes++ == 0) {
            *row = *one;
            continue;
        }
        row->interior_maximum = fmax(row->interior_maximum, one->interior_maximum);
        row->interior_rms = fmax(row->interior_rms, one->interior_rms);
        row->noise = fmax(row->noise, one->noise);
        row->time += one->time;
        for (int run = 0; run < RESULT_RUNS; run++)
            row->run_times[run] += one->run_times[run];
    }
    row->time /= scenes;
    for (int run = 0; run < RESULT_RUNS; run++)
        row->run_times[run] /= scenes;
    snprintf(row->scene, sizeof row->scene, "%s", SCENE_CLASS_NAMES[class]);
    return scenes > 0;
}

static bool calibrate_class(const Survey *survey, SceneClass class, Efficient *table,
                            Message *message)
{
    Results merged = {.rows = NULL};
    Front front;
    bool done = true;
    for (int i = 0; i < survey->results.count && done; i++) {
        const Setting *setting = &survey->results.rows[i].setting;
        ResultRow row;
        if (efficient_allows(setting) &&
            !results_find(&merged, SCENE_CLASS_NAMES[class], setting) &&
            merge(&survey->results, class, setting, &row))
            done = results_add(&merged, &row, message);
    }
    done = done &&
           front_open(&front, &merged, SCENE_CLASS_NAMES[class], ERROR_INTERIOR_MAXIMUM, message);
    if (done) {
        if (front.count == 0)
            done = message_set(message,
                               "--calibrate: at %dx%d no setting is measured for scenes of the "
                               "class %s, for no pixel lies inside an object; draw larger",
                               survey->like.width, survey->like.height, SCENE_CLASS_NAMES[class]);
        for (int i = 0; i < front.count && table->count < EFFICIENT_MOST_ROWS; i++)
            table->rows[table->count++] = (EfficientRow){.class = class,
                                                         .setting = front.rows[i]->setting,
                                                         .maximum = front.rows[i]->interior_maximum,
                                                         .rms = front.rows[i]->interior_rms,
                                                         .milliseconds = front.rows[i]->time};
        front_close(&front);
    }
    results_close(&merged);
    return done;
}

bool choose_calibrate(Survey *survey, Message *message)
{
    char path[PATH_MAX], with[256];
    Efficient *table = calloc(1, sizeof *table);
    bool done = table || message_set(message, "study: not enough memory");
    for (int class = 0; class < SCENE_CLASS_COUNT && done; class ++)
        done = calibrate_class(survey, (SceneClass) class, table, message);
    snprintf(with, sizeof with, "%s, LP_NUM_THREADS %s, %dx%d", survey->like.renderer,
             survey->like.threads, survey->like.width, survey->like.height);
    done = done && efficient_path_to_write(path, message) &&
           efficient_write(table, path, with, message);
    if (done)
        printf("%s: %d settings for %d classes of scenes\n", path, table->count, SCENE_CLASS_COUNT);
    free(table);
    return done;
}
