/*
 * options: every option, and every bad value.
 */
#include "app/options.h"
#include "images/image_file.h"
#include "scene/scene_example.h"
#include "support/read_line.h"
#include "support/testing.h"

static const Usage PROGRAM = {.name = "LightedCube", .summary = "A summary."};
static void twice_as_wide(int *width, int *height)
{
    *width = 2 * *height;
}

static const Example SCENE_PROGRAM = {.name = "Scene",
                                      .summary = "A summary.",
                                      .kind = &SCENE_KIND,
                                      .content = &(const SceneExample){.make = NULL}};
static Usage SCENE; /* its own */
static const Usage GALLERY = {.name = "gallery", .summary = "A summary.", .gallery = true};

static Options options;
static Message message;

static OptionsResult read_as(const Usage *usage, const char *line)
{
    message = (Message){0};
    return read_line(&options, usage, line, &message);
}

static void accept(const char *line)
{
    if (read_as(&PROGRAM, line) != OPTIONS_RUN)
        fail_msg("refused: %s: %s", line, message.text);
    assert_string_equal(message.text, "");
}

/* The line is accepted, and then the condition holds. */
#define reads(line, condition) (accept(line), assert_true(condition))

static void refuse_as(const Usage *usage, const char *line, const char *said)
{
    if (read_as(usage, line) != OPTIONS_BAD)
        fail_msg("accepted: %s", line);
    if (!strstr(message.text, said))
        fail_msg("%s: expected \"%s\" in \"%s\"", line, said, message.text);
    if (strchr(message.text, '\n'))
        fail_msg("%s: more than one line: %s", line, message.text);
    assert_false(message.located);
}

static void refuse(const char *line, const char *said)
{
    refuse_as(&PROGRAM, line, said);
}

TEST(without_options_the_defaults_are_those_of_the_lecture)
{
    accept("");
    assert_string_equal(options.output, "LightedCube.png");
    assert_false(options.output_given);
    assert_int_equal(options.width, 400);
    assert_int_equal(options.height, 400);
    assert_true(options.seconds == 0);
    assert_int_equal(options.frames, 1);
    assert_true(options.fps == 30);
    assert_null(options.canvas.backend);
    assert_int_equal(options.canvas.samples, 0);
    assert_null(options.shaders.folder);
    assert_null(options.shaders.precision);
    assert_int_equal(options.shaders.print, 0);
    assert_int_equal(options.compress, IMAGE_COMPRESS_DEFAULT);
    assert_false(options.alpha || options.verbose || options.doctor);
    assert_null(options.names[0]);
}

TEST(every_option_is_read_in_its_short_and_long_form)
{
    static const char *const outputs[] = {"-o a.png",       "-oa.png",     "--output a.png",
                                          "--output=a.png", "--out a.png", "-o b.png -o a.png"};
    for (size_t i = 0; i < sizeof outputs / sizeof outputs[0]; i++) {
        accept(outputs[i]);
        assert_string_equal(options.output, "a.png");
        assert_true(options.output_given);
    }
    static const char *const sizes[] = {"-s 3x16384", "--size 3x16384", "--size=3X16384"};
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        accept(sizes[i]);
        assert_int_equal(options.width, 3);
        assert_int_equal(options.height, 16384);
    }
    reads("-s 007", options.width == 7 && options.height == 7);
    reads("-t -1.5", options.seconds == -1.5);
    reads("--time=2e3", options.seconds == 2000);
    reads("-a 90", options.seconds == 3); /* at the lecture's 30 degrees a second */
    reads("--angle -45", options.seconds == -1.5);
    reads("-t 1 -a 90 -t 5", options.seconds == 5); /* the last one counts */
    reads("-n 7 -o x%d.png", options.frames == 7);
    accept("--frames 1000000 --fps 0.5");
    assert_int_equal(options.frames, FRAMES_MAX);
    assert_true(options.fps == 0.5);
    reads("--samples 4", options.canvas.samples == 4);
    reads("-b egl", options.canvas.backend == &CANVAS_EGL);
    reads("--backend=egl", options.canvas.backend == &CANVAS_EGL);
    reads("--shaders some/folder", strcmp(options.shaders.folder, "some/folder") == 0);
    reads("--precision highp", strcmp(options.shaders.precision, "highp") == 0);
    reads("--precision mediump", strcmp(options.shaders.precision, "mediump") == 0);
    reads("--print-shader", options.shaders.print == (SHADER_PRINT_VERTEX | SHADER_PRINT_FRAGMENT));
    reads("--print-shader=vert", options.shaders.print == SHADER_PRINT_VERTEX);
    reads("--print-shader=frag", options.shaders.print == SHADER_PRINT_FRAGMENT);
    reads("--alpha", options.alpha);
    reads("--compress 0", options.compress == 0);
    reads("--compress 9", options.compress == 9);
    reads("-v", options.verbose);
    reads("--verbose", options.verbose);
    reads("--doctor", options.doctor);
}

/* An option's bad values; the empty one is another. */
typedef struct BadValues {
    const char *option, *values[18];
} BadValues;

static void refuse_all(const Usage *usage, const BadValues *cases, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        char line[128];
        for (const char *const *value = cases[i].values; *value; value++) {
            snprintf(line, sizeof line, "%s=%s", cases[i].option, *value);
            refuse_as(usage, line, formatted("%s %s: ", cases[i].option, *value));
        }
        snprintf(line, sizeof line, "%s=", cases[i].option);
        refuse_as(usage, line, cases[i].option);
    }
}

TEST(every_bad_value_is_refused_with_the_option_and_the_value)
{
    static const BadValues cases[] = {
        {"--size",
         {"0", "400x", "x400", "0x0", "20000x1", "1x16385", "-1x5", "4x4x4", "x", "1.5x2", "0x10x4",
          "99999999999x1", "4294967297x1", "1e2x1", "+1x1"}},
        {"--time",
         {"nan", "-nan", "inf", "-infinity", "0x10", "1e999", "2e9", "-2e9", "abc", "1s", "--",
          "+-1", "1,5"}},
        {"--angle", {"nan", "inf", "0x5a", "4e10", "abc", "90deg"}},
        {"--frames", {"0", "-1", "1.5", "abc", "1000001", "1e9", "nan", "0x2", "3x"}},
        {"--fps", {"0", "-30", "nan", "inf", "2e6", "abc", "1e-9"}},
        {"--samples", {"-1", "1.5", "abc", "nan", "4x", "1e99"}},
        {"--orbit",
         {"1", "1,", ",1", "1,2,", "1,2,3,4,5", "1,2,1,36001", "1,91", "1,-91", "36001,0", "1,2,0",
          "1,2,101", "1;2", "nan,0"}},
        {"--backend", {"vulkan", "EGL", "eg"}},
        {"--precision", {"lowp", "high", "HIGHP", "highp,mediump"}},
        {"--print-shader", {"fragment", "both", "vert,frag"}},
        {"--compress", {"-1", "10", "1.5", "best"}},
    };
    static const BadValues of_scenes[] = {
        {"--light-at",
         {"0", "0,1,2", "0,1,2,3,4", "8,1,2,3", "-1,1,2,3", "0,1,2,", "0,1,2,3/", "/0,1,2,3",
          "x,1,2,3", "0,1,2,x", "0,,1,2", "0,1,2,3/0,1", "0,1e7,0,0"}},
        {"--light-color",
         {"0", "0,1,1", "0,1,1,1,1", "8,1,1,1", "-1,1,1,1", "0,1,1,-1", "0,1,1,11", "0,1,1,1/",
          "/0,1,1,1", "0,1,1,1,", "0,,1,1", "0,1,1,x", "0,1,1,1,1,1", ",0,1,1,1", "0,1,1,nan",
          "0,1,1,1,1,1,1,1"}},
        {"--terms",
         {"difuse", "diffuse,", ",diffuse", "32", "-1", "1,,2", "Diffuse", "specularspecular",
          "0000000000000000x"}},
    };
    refuse_all(&PROGRAM, cases, sizeof cases / sizeof cases[0]);
    refuse_all(&SCENE, of_scenes, sizeof of_scenes / sizeof of_scenes[0]);
    refuse_as(&SCENE, "--terms diffuse ambient", "ambient");
    refuse("--terms diffuse", "--terms");
    refuse("--output=", "--output: the name is empty");
    refuse("-o \"\"", "--output: the name is empty");
    refuse("--shaders=", "--shaders: the name is empty");
    refuse("--backend osmosis", "there is egl");
}

TEST(an_option_without_its_value_says_so)
{
    static const char *const lines[] = {
        "--output",  "--size",    "--time",    "--angle",     "--frames",   "--fps",
        "--samples", "--backend", "--shaders", "--precision", "--compress", "-o",
        "-s",        "-t",        "-a",        "-n",          "-b"};
    for (size_t i = 0; i < sizeof lines / sizeof lines[0]; i++)
        refuse(lines[i], formatted("%s: needs a value", lines[i]));
    refuse("-vo", "-o: needs a value");
}

TEST(what_is_no_option_is_named)
{
    static const struct {
        const char *line, *said;
    } cases[] = {
        /* a value that is not taken */
        {"--alpha=1", "--alpha=1: takes no value"},
        {"--verbose=very", "takes no value"},
        {"--help=me", "takes no value"},
        /* unknown: the nearest name */
        {"--sise 4x4", "--sise: no such option; did you mean --size?"},
        {"--ouptut=a.png", "did you mean --output?"},
        {"--Samples 4", "did you mean --samples?"},
        {"--precison highp", "did you mean --precision?"},
        {"--print-shaders", "did you mean --print-shader?"},
        {"--fsp 3", "did you mean --fps?"},
        {"--xylophone", "--xylophone: no such option; --help lists them"},
        {"--=3", "no such option"},
        {"-z", "-z: no such option; --help lists them"},
        /* a letter at any position */
        {"-vz", "-z: no such option"},
        {"-zv", "-z: no such option"},
        {"--verbose -zv", "-z: no such option"},
        {"--alpha -zo a.png", "-z: no such option"},
        /* an ambiguous abbreviation */
        {"--pr", "--precision"},
        {"--pr", "--print-shader"},
        {"--s 4", "--samples"},
        /* an argument */
        {"picture.png", "picture.png: not an option"},
        {"-v picture.png --alpha", "picture.png: not an option"},
        {"-- --alpha", "--alpha: not an option"},
        {"-", "-: not an option"},
        {"\"\"", "not an option"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++)
        refuse(cases[i].line, cases[i].said);
}

TEST(without_a_size_it_is_the_programs)
{
    Usage usage = PROGRAM;
    int width, height;
    options_size(&usage, &width, &height);
    assert_true(width == 400 && height == 400);
    usage.width = 300;
    usage.height = 200;
    options_size(&usage, &width, &height);
    assert_true(width == 300 && height == 200);
    usage.resize = twice_as_wide;
    options_size(&usage, &width, &height);
    assert_true(width == 400 && height == 200);
    assert_int_equal(read_as(&usage, ""), OPTIONS_RUN);
    assert_true(options.width == 400 && options.height == 200);
    assert_int_equal(read_as(&usage, "--size 50x60"), OPTIONS_RUN);
    assert_true(options.width == 50 && options.height == 60);
}

/* Terms and lights. */

static const char *const LIGHT_NUMBERS[] = {"0", "1", "2", "31"};
static const char *const TERMS[] = {"ambient", "diffuse", "specular", "emission"};

/* An option of scenes, with its value in `options`. */
static Parameter scene_row(const char *name)
{
    static Parameter table[OPTIONS_MAX];
    Parameter *row = table;
    options_table(&SCENE, &options, OPTIONS_TO_WRITE, table);
    while (row->name && strcmp(row->name, name) != 0)
        row++;
    assert_non_null(row->name);
    return *row;
}

/* Writes an option of scenes, and reads what was written. */
static void write_and_read(const char *name)
{
    char text[PARAMETER_TEXT_SIZE];
    const Parameter row = scene_row(name);
    assert_true(parameter_write(&row, text, sizeof text));
    assert_int_equal(read_as(&SCENE, formatted("--%s %s", name, text)), OPTIONS_RUN);
}

/* Every set of terms and of four lights, in both orders; what is written is read as the same. */
TEST(every_set_of_terms_and_lights_is_read_and_written)
{
    for (unsigned bits = 1; bits < 1 << 8; bits++) {
        char line[PARAMETER_TEXT_SIZE] = "--terms ";
        for (int i = 0; i < 8; i++) {
            const int k = bits & 1 ? i : 7 - i;
            if (bits >> k & 1)
                snprintf(line + strlen(line), sizeof line - strlen(line), "%s%s",
                         line[strlen(line) - 1] == ' ' ? "" : ",",
                         k < 4 ? TERMS[k] : LIGHT_NUMBERS[k - 4]);
        }
        if (read_as(&SCENE, line) != OPTIONS_RUN)
            fail_msg("refused: %s: %s", line, message.text);
        const uint32_t lights = (bits >> 4 & 7) | (uint32_t)(bits >> 7) << 31;
        const SceneTerms read = options.terms;
        assert_int_equal(read.left_out, bits & 15 ? TERM_ALL & ~bits : 0);
        assert_int_equal(read.lights_left_out, lights ? ~lights : 0);
        assert_false(read.unlit);
        write_and_read("terms");
        assert_memory_equal(&options.terms, &read, sizeof read);
    }
    assert_int_equal(read_as(&SCENE, ""), OPTIONS_RUN);
    assert_true(options.terms.left_out == 0 && options.terms.lights_left_out == 0);
}

/* All lights but one are the longest text. */
TEST(the_longest_terms_fit)
{
    for (unsigned left_out = 0; left_out < 32; left_out++) {
        assert_int_equal(read_as(&SCENE, ""), OPTIONS_RUN);
        options.terms.lights_left_out = (uint32_t)1 << left_out;
        write_and_read("terms");
        assert_int_equal(options.terms.lights_left_out, (uint32_t)1 << left_out);
    }
}

TEST(lights_are_put_elsewhere)
{
    char text[PARAMETER_TEXT_SIZE];
    assert_int_equal(read_as(&SCENE, ""), OPTIONS_RUN);
    assert_int_equal(options.places.placed, 0);
    const Parameter row = scene_row("light-at");
    assert_false(parameter_write(&row, text, sizeof text));
    assert_int_equal(read_as(&SCENE, "--light-at 1,0.5,-2,1e3/7,0,0,1"), OPTIONS_RUN);
    assert_int_equal(options.places.placed, 1 << 1 | 1 << 7);
    assert_true(options.places.at[1].x == 0.5 && options.places.at[1].y == -2 &&
                options.places.at[1].z == 1000 && options.places.at[7].z == 1);
    /* All of them, as they are dragged. */
    options.places.placed = 255;
    for (int i = 0; i < SCENE_MAX_PLACED; i++)
        options.places.at[i] = (Vec3){-12.345 - i, -0.001 * i, 100.123};
    const LightPlaces all = options.places;
    write_and_read("light-at");
    for (int i = 0; i < SCENE_MAX_PLACED; i++)
        assert_memory_equal(&options.places.at[i], &all.at[i], sizeof all.at[i]);
}

TEST(lights_get_other_colors)
{
    char text[PARAMETER_TEXT_SIZE];
    assert_int_equal(read_as(&SCENE, ""), OPTIONS_RUN);
    Parameter row = scene_row("light-color");
    assert_false(parameter_write(&row, text, sizeof text));
    assert_int_equal(read_as(&SCENE, "--light-color 1,0.5,0,1/7,0,0,1,1,1,10"), OPTIONS_RUN);
    assert_int_equal(options.tints.tinted, 1 << 1 | 1 << 7);
    assert_true(options.tints.diffuse[1].x == 0.5 && options.tints.specular[1].z == 1 &&
                options.tints.diffuse[7].z == 1 && options.tints.specular[7].z == 10);
    row = scene_row("light-color");
    assert_true(parameter_write(&row, text, sizeof text));
    assert_string_equal(text, "1,0.5,0,1/7,0,0,1,1,1,10");
    /* All of them, in as many digits as there are. */
    options.tints.tinted = 255;
    for (int i = 0; i < SCENE_MAX_PLACED; i++) {
        options.tints.diffuse[i] = vec3_scale((Vec3){1, 2, 3}, 1.2345678901234501e-5 * (i + 1));
        options.tints.specular[i] = vec3_scale(options.tints.diffuse[i], 1.0 / 3);
    }
    const LightTints all = options.tints;
    write_and_read("light-color");
    assert_memory_equal(&options.tints, &all, sizeof all);
}

TEST(the_default_output_is_named_for_the_program)
{
    accept("");
    assert_string_equal(options.output, "LightedCube.png");
    accept("-n 3");
    assert_string_equal(options.output, "LightedCube%04d.png");
    assert_false(options.output_given);
    assert_int_equal(read_as(&GALLERY, ""), OPTIONS_RUN);
    assert_string_equal(options.output, "gallery");
}

TEST(an_output_that_cannot_be_a_picture_is_refused)
{
    refuse("-o folder/", "folder/: is a folder");
    refuse("-o picture", "picture: the extension names the format");
    refuse("-o folder.png/picture", "folder.png/picture: the extension");
    refuse("-o .png", "the extension");
    refuse("-o picture.", "the extension");
    refuse("-o - -n 2", "standard output takes one picture as PNG, not 2; --format y4m or rgb");
    refuse("-o - -n 2 --format png", "standard output takes one picture as PNG");
    accept("-o picture.PNG");
    accept("-o /dev/null");
    accept("-o 100%.png"); /* the name of a single picture is used as it is */
}

TEST(several_pictures_need_exactly_one_number_in_the_name)
{
    static const char *const bad[] = {"a.png",  "a%%.png",   "%d%d.png", "a%s.png",
                                      "a%.png", "a%-3d.png", "a%x.png",  "a%100d.png"};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        refuse(formatted("--frames 2 -o %s", bad[i]), bad[i]);
    accept("--frames 2 -o a%d.png");
    accept("--frames 2 -o a%04d.png");
    accept("--frames 2 -o 100%%_%3d.png");
    accept("--frames 1 -o a.png");
    assert_null(options.animation);
    accept("-o a.png --print-shader --frames 2"); /* nothing is written, so any name is accepted */
}

static void takes(const char *line, const char *animation, bool numbered)
{
    accept(line);
    if (!animation != !options.animation ||
        (animation && strcmp(options.animation, animation) != 0))
        fail_msg("%s: %s", line, options.animation ? options.animation : "no animation");
    assert_int_equal(options.numbered, numbered);
}

TEST(pictures_go_to_one_animation_or_each_to_its_file)
{
    takes("-o a.gif", NULL, false);
    takes("-o a.webp", NULL, false);
    takes("-o a.gif -n 1", NULL, false);
    takes("-o a.gif -n 2", "gif", false);
    takes("-o a.WEBP -n 2", "webp", false);
    takes("-o a.mp4", "mp4", false);
    takes("-o a.apng -n 2", "apng", false);
    takes("-o 100%.webm -n 2", "webm", false);
    takes("-o a%d.gif -n 2", NULL, true);
    takes("-o a%d.webp -n 1", NULL, true);
    takes("-o a.webp -n 2 --alpha", "webp", false);
    refuse("-o a%d.mp4 -n 2", "a%d.mp4: a .mp4 holds all the pictures; leave the number out");
    refuse("-o a%d.apng -n 1", "leave the number out");
    refuse("-o a.gif --alpha", ".gif has no alpha channel");
    refuse("-o a.gif -n 2 --alpha", "gif has no alpha channel");
    refuse("-o a.mp4 --alpha", "mp4 has no alpha channel");
    refuse("-o a.gif -n 2 --fps 101", "gif has 0.001526 to 100");
    refuse("-o a.webm --fps 1001", "webm has 0.001 to 1000");
    refuse("-o a.png --format y4m", "--format y4m: applies to standard output, -o -");
    refuse("--format png", "--format png: applies to standard output, -o -");
    refuse("-o - --format gif", "--format gif: must be png, y4m, rgb or json");
    refuse("-o - --format json", "--format json: is of --probe");
    refuse("--probe 400,1", "--probe 400,1: the picture has 400x400 pixels, counted from 0,0");
    refuse("--probe 9,30 -s 40x30", "--probe 9,30: the picture has 40x30 pixels");
    refuse("-o - --format y4m --alpha", "y4m has no alpha channel");
    refuse_as(&GALLERY, "--format y4m", "--format: a gallery");
    takes("-o a.mp4 --print-shader --format y4m", NULL, false);
}

TEST(a_gallery_takes_names_and_a_folder_but_no_frames)
{
    assert_int_equal(read_as(&GALLERY, "LightedCube -s 64x64 PointLightedCube -o here"),
                     OPTIONS_RUN);
    assert_string_equal(options.output, "here"); /* needs no extension */
    assert_true(options.output_given);
    assert_int_equal(options.width, 64);
    assert_string_equal(options.names[0], "LightedCube");
    assert_string_equal(options.names[1], "PointLightedCube");
    assert_null(options.names[2]);
    assert_int_equal(read_as(&GALLERY, "-o here/"), OPTIONS_RUN);
    refuse_as(&GALLERY, "-n 2", "--frames: a gallery");
    refuse_as(&GALLERY, "--fps 2", "--fps: a gallery");
    refuse_as(&GALLERY, "-s 4x", "--size 4x: must be");
}

int main(void)
{
    SCENE = options_usage(&SCENE_PROGRAM);
    return testing_run(0, "options", NULL, NULL);
}
