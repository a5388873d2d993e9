/*
 * The catalogue against itself: single mistakes and pairs, drawn by wrong_program, are found again.
 * Independently written mistakes are in labs_test.py.
 *
 * Environment: LABS_SEEDS and LABS_PAIRS set the number of seeds per mistake and of pairs per lab.
 * Default: every sixteenth form of a mistake in one seed, and 3 pairs; a part of them in the short
 * form.
 */
#include "labs/diagnosis/diagnose.h"
#include "labs/diagnosis/wrong_program.h"
#include "support/picture_check.h"
#include "support/testing.h"

/* Paints as a suspect instead of a submission's program. */
typedef struct Fake {
    const WrongProgram *program;
    const Choices *choices;
} Fake;

static Canvas canvas;
static WrongProgram program;

static bool paint_fake(const Painter *painter, const LabScene *lab_scene,
                       const SubmissionGeometry *geometry, Message *message)
{
    const Fake *fake = painter->what;
    LabSceneBuffers buffers;
    if (!lab_scene_buffers_open(&buffers, lab_scene, geometry, message))
        return false;
    const bool done =
        wrong_program_draw(fake->program, painter->lab, lab_scene, &buffers, fake->choices);
    lab_scene_buffers_close(&buffers);
    return done;
}

/* The program for a lab: lab 11's has shadows. */
static void use_program(const Lab *lab)
{
    Message message = {0};
    wrong_program_close(&program);
    if (!wrong_program_open(&program, lab, &message))
        fail_msg("%s", message.text);
}

typedef enum Outcome { HIDDEN, NAMED, UNNAMED, ONE_OF, MISNAMED } Outcome;

static bool has(const Verdict *verdict, int mistake)
{
    for (int i = 0; i < verdict->mistake_count; i++)
        if (strcmp(verdict->mistakes[i].name, MISTAKES[mistake].name) == 0)
            return true;
    return false;
}

static Outcome outcome_of(const Verdict *verdict, const Suspect *made)
{
    const bool pair = made->mistakes[1] >= 0;
    int right = has(verdict, made->mistakes[0]) + (pair && has(verdict, made->mistakes[1]));
    if (verdict->mistake_count == 0)
        return UNNAMED;
    if (verdict->one_of)
        return right > 0 ? ONE_OF : MISNAMED;
    if (right < verdict->mistake_count)
        return MISNAMED;
    return NAMED; /* one of a pair may hide the other */
}

static Outcome try(const Lab *lab, const Suspect *made, uint64_t seed, Verdict *verdict)
{
    Message message = {0};
    static LabPictures pictures;
    const Fake fake = {&program, &made->choices};
    const Painter painter = {.lab = lab, .paint = paint_fake, .what = &fake};
    bool wrong = false, moved = false;
    *verdict = (Verdict){.seed = seed};
    if (!lab_pictures_open(&pictures, lab, seed, &message))
        fail_msg("%s", message.text);
    if (lab->budget && !lab_pictures_use_sphere(&pictures, 24, 24, &message))
        fail_msg("%s", message.text);
    if (!lab_pictures_draw(&pictures, &painter, &canvas, &message))
        fail_msg("%s", message.text);
    for (int i = 0; i < pictures.count; i++)
        wrong |= lab_pictures_error(&pictures, i, pictures.truth).maximum >
                 lab_pictures_tolerance(&pictures, i);
    if (wrong && (!outline_check(&pictures, &painter, &canvas, &moved, &message) ||
                  !diagnose(&pictures, &painter, moved, &canvas, verdict, &message)))
        fail_msg("%s", message.text);
    lab_pictures_close(&pictures);
    return wrong ? outcome_of(verdict, made) : HIDDEN;
}

static int number_of(const char *name, int otherwise)
{
    const char *text = getenv(name);
    return text ? atoi(text) : otherwise;
}

static void say(const Lab *lab, const Suspect *made, uint64_t seed, Outcome outcome,
                const Verdict *verdict)
{
    static const char *const NAMES[] = {"not visible", "named", "unnamed", "one of", "MISNAMED"};
    printf("%s, seed %d: %s%s%s: %s", lab->file, (int)seed, MISTAKES[made->mistakes[0]].name,
           made->mistakes[1] >= 0 ? " + " : "",
           made->mistakes[1] >= 0 ? MISTAKES[made->mistakes[1]].name : "", NAMES[outcome]);
    for (int i = 0; i < verdict->mistake_count; i++)
        printf("%s %s", i ? "," : ":", verdict->mistakes[i].name);
    printf("\n");
}

/* Single mistakes: named in 95% of seeds, never misnamed. Mistakes that look alike in every scene
 * are named as "one of". */
TEST(test_singles)
{
    static Verdict verdict;
    const int seeds = number_of("LABS_SEEDS", 1),
              step = getenv("LABS_SEEDS") ? 1 : 16 * testing_step(24);
    int all_tried = 0, all_named = 0;
    for (int l = 0; l < LAB_COUNT; l += testing_step(2)) {
        const Lab *lab = &LABS[l];
        int count = 0, tried = 0, misnamed = 0;
        Suspect *singles = catalogue_singles(lab, &count);
        assert_non_null(singles);
        use_program(lab);
        int named = 0, kinds = 0;
        for (int i = 0; i < count; i++) {
            /* Once, not for each right stage. */
            kinds += (i == 0 || singles[i].mistakes[0] != singles[i - 1].mistakes[0]) &&
                     !singles[i].choices.of[SLOT_FIT] &&
                     singles[i].choices.of[SLOT_STAGE] != STAGE_OTHER;
            for (int seed = 1; seed <= seeds && i % step == l % step; seed++) {
                const Outcome outcome = try(lab, &singles[i], (uint64_t)seed, &verdict);
                tried++;
                named += outcome == NAMED || outcome == ONE_OF;
                misnamed += outcome == MISNAMED;
                if (outcome != NAMED)
                    say(lab, &singles[i], (uint64_t)seed, outcome, &verdict);
            }
        }
        free(singles);
        printf("%s: %d mistakes, %d of %d named, %d misnamed\n", lab->file, kinds, named, tried,
               misnamed);
        assert_true(kinds >= 20);
        assert_int_equal(misnamed, 0);
        all_tried += tried;
        all_named += named;
    }
    assert_true(all_named >= 0.95 * all_tried);
}

/* Pairs: named in 70%, over all labs because of so few in each; never misnamed. */
TEST(test_pairs)
{
    static Verdict verdict;
    const int pairs = number_of("LABS_PAIRS", testing_part(3, 3));
    int all_named = 0, all_tried = 0;
    Random random = {7};
    for (int l = 0; l < LAB_COUNT; l += testing_step(5)) {
        const Lab *lab = &LABS[l];
        int count = 0, named = 0, misnamed = 0;
        Suspect *singles = catalogue_singles(lab, &count), pair;
        assert_non_null(singles);
        use_program(lab);
        for (int i = 0; i < pairs;) {
            const int a = (int)random_between(&random, 0, count - 1e-9);
            const int b = (int)random_between(&random, 0, count - 1e-9);
            if (!catalogue_pair(&singles[a], &singles[b], &pair))
                continue;
            const Outcome outcome = try(lab, &pair, (uint64_t)i + 1, &verdict);
            named += outcome == NAMED || outcome == ONE_OF;
            misnamed += outcome == MISNAMED;
            if (outcome != NAMED)
                say(lab, &pair, (uint64_t)i + 1, outcome, &verdict);
            i++;
        }
        free(singles);
        printf("%s: %d of %d pairs named, %d misnamed\n", lab->file, named, pairs, misnamed);
        assert_int_equal(misnamed, 0);
        all_named += named;
        all_tried += pairs;
    }
    assert_true(all_named >= 0.7 * all_tried);
}

int main(void)
{
    Message message = {0};
    const CanvasOptions size = {.width = 96, .height = 96};
    setenv("LP_NUM_THREADS", "0", 0);
    if (!picture_check_driver("diagnose"))
        return EXIT_SKIPPED;
    if (!canvas_open(&canvas, &size, &message)) {
        fprintf(stderr, "%s\n", message.text);
        return 1;
    }
    const int failed = testing_run(0, "diagnose", NULL, NULL);
    wrong_program_close(&program);
    canvas_close(&canvas);
    return failed;
}
