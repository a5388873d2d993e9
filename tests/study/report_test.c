/*
 * report: tables line up, plots are whole files that gnuplot drew, sheets show what is different.
 */
#include "study/cases/hard_sheet.h"
#include "study/report/conclusions.h"
#include "study/report/report.h"
#include "study/report/report_gnuplot.h"
#include "support/testing.h"

#include <png.h>
#include <sys/stat.h>
#include <unistd.h>

static Results results;

static void add(const char *divisions, const char *interpolation, double error, double time)
{
    ResultRow row = {.quality = quality_usual(),
                     .scene = "sphere",
                     .width = 400,
                     .height = 300,
                     .interior_maximum = error,
                     .interior_rms = error / 3,
                     .all_rms = error / 2,
                     .all_maximum = NAN,
                     .time = time,
                     .time_lower = 0.9 * time,
                     .time_upper = 1.1 * time,
                     .run_times = {time, time, time},
                     .net_time = time - 0.5,
                     .gpu_time = NAN,
                     .noise = 0.05,
                     .vertices = 100,
                     .fragments = -1,
                     .vertex_operations = 20,
                     .fragment_operations = -1,
                     .renderer = "llvmpipe",
                     .threads = "2"};
    SUCCEEDS(quality_choose(&row.quality, "divisions", divisions, message));
    SUCCEEDS(quality_choose(&row.quality, "interpolation", interpolation, message));
    results_add(&results, &row);
}

static void add_four(void)
{
    add("24", "gouraud", 12.5, 1);
    add("32", "gouraud", 30, 1.02);
    add("64", "phong", 0.002, 3);
    add("64", "flat", 7, 12.25);
}

static char *table(bool only_efficient)
{
    char *text = NULL;
    size_t size = 0;
    FILE *file = open_memstream(&text, &size);
    assert_non_null(file);
    SUCCEEDS(report_table(&results, "sphere", only_efficient, file, message));
    fclose(file);
    return text;
}

static int enter(void **state)
{
    return testing_enter_folder(state) != 0 || mkdir("out", 0777) != 0;
}

static int leave(void **state)
{
    results_close(&results);
    return testing_leave_folder(state);
}

TEST_WITH(0, a_table_is_sorted_and_marked, enter, leave)
{
    add_four();
    char *text = table(false);
    assert_string_equal(
        text, "sphere, 400x300; llvmpipe, LP_NUM_THREADS 2; noise 5.0 %\n"
              "Errors in steps of 1/255. * efficient by the largest error inside the objects.\n"
              "= tied: its median would make it efficient too, but that is within the noise.\n"
              "\n"
              "      ms       quartiles  net ms  inside: max    rms  all: max    rms  vertices  "
              "fragments  operations  setting\n"
              "*   1.00    [0.90, 1.10]    0.50        12.50   4.17         -   6.25       100  "
              "        -        20/-  interpolation=gouraud divisions=24\n"
              "    1.02    [0.92, 1.12]    0.52        30.00  10.00         -  15.00       100  "
              "        -        20/-  interpolation=gouraud divisions=32\n"
              "*   3.00    [2.70, 3.30]    2.50        <0.01  <0.01         -  <0.01       100  "
              "        -        20/-  usual\n"
              "   12.25  [11.03, 13.48]   11.75         7.00   2.33         -   3.50       100  "
              "        -        20/-  interpolation=flat\n");
    free(text);
}

TEST_WITH(0, a_sentence_compares_at_the_error_that_both_reach, enter, leave)
{
    char text[CONCLUSION_SIZE];
    conclusion_of_scene(&results, "sphere", text);
    assert_string_equal(text, "");
    add("24", "gouraud", 12.5, 1);
    add("96", "gouraud", 1.31, 17.2);
    add("24", "phong", 1.3, 1.84);
    add("64", "phong", 0.6, 9);
    add("64", "flat", 0.1, 0.1);
    conclusion_of_scene(&results, "sphere", text);
    assert_string_equal(text, "1.3 steps: Phong interpolation 1.8 ms, Gouraud 17 ms");
    add("24", "phong", 1.3, 16.9); /* a later one counts */
    conclusion_of_scene(&results, "sphere", text);
    assert_string_equal(text, "1.3 steps: Phong interpolation 9.0 ms, Gouraud 17 ms");
    add("64", "phong", 0.6, 17);
    conclusion_of_scene(&results, "sphere", text);
    assert_string_equal(
        text, "1.3 steps: Phong interpolation 17 ms, Gouraud 17 ms (the same within the noise)");
    for (int i = 0; i < results.count; i++)
        results.rows[i].noise = 0.37;
    conclusion_of_scene(&results, "sphere", text);
    assert_string_equal(text, "");
}

TEST_WITH(0, only_the_efficient_ones_if_asked, enter, leave)
{
    add_four();
    char *text = table(true);
    assert_non_null(strstr(text, "divisions=24"));
    assert_non_null(strstr(text, "usual"));
    assert_null(strstr(text, "divisions=32"));
    assert_null(strstr(text, "flat"));
    assert_null(strstr(text, "*="));
    free(text);
}

TEST_WITH(0, a_table_has_the_gpu_s_times_if_they_are_known, enter, leave)
{
    ResultRow row;
    add_four();
    row = results.rows[0];
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        row.quality.choice[axis] = (unsigned char)(QUALITY_AXES[axis].count - 1);
    row.gpu_time = 1234.5;
    row.vertices = row.fragments = 123456789;
    row.noise = 0.1;
    results_add(&results, &row);
    char *text = table(false);
    assert_non_null(strstr(text, "noise 5.0 to 10.0 %"));
    assert_non_null(strstr(text, "GPU"));
    assert_non_null(strstr(text, "1234.50"));
    free(text);
}

TEST_WITH(0, no_rows_and_full_disks_are_reported, enter, leave)
{
    FAILS(report_table(&results, "cube", false, stdout, message), "cube: nothing was measured");
    FAILS(report_plot(&results, "cube", "", ".", message), "cube: nothing was measured");
    add_four();
    FILE *full = fopen("/dev/full", "w");
    assert_non_null(full);
    FAILS_WITH(report_table(&results, "sphere", false, full, message), "No space left on device");
    fclose(full);
}

/* Plots. */

static bool has_gnuplot(void)
{
    return system("gnuplot --version >/dev/null 2>&1") == 0;
}

/* Both files are there, whole, with nothing beside them; the text of the first, to be freed. */
static char *drawn(const char *name)
{
    char path[64];
    size_t size;
    snprintf(path, sizeof path, "out/%s.png", name);
    char *png = testing_read(path, &size);
    assert_true(size > 1000);
    assert_memory_equal(png, "\x89PNG\r\n\x1a\n", 8);
    assert_memory_equal(png + size - 8, "IEND\xAE\x42\x60\x82", 8);
    free(png);
    snprintf(path, sizeof path, "out/%s.svg", name);
    char *svg = testing_read(path, &size);
    assert_non_null(strstr(svg, "</svg>"));
    assert_int_equal(testing_entries("out"), 2);
    return svg;
}

static bool plot(const char *title, Message *message)
{
    return report_plot(&results, "sphere", title, "out", message);
}

TEST_WITH(0, a_plot_names_the_efficient_ones, enter, leave)
{
    if (!has_gnuplot())
        skip();
    add_four();
    SUCCEEDS(plot("It's `date` \"quoted\" \\n $HOME @x ^2_3 <&> {/Bold x}", message));
    char *svg = drawn("sphere");
    assert_non_null(strstr(svg, "It's `date` \"quoted\" \\n $HOME @x ^2_3 &lt;&amp;> {/Bold x}"));
    assert_non_null(strstr(svg, ">interpolation=gouraud<"));
    assert_non_null(strstr(svg, ">usual<"));
    assert_null(strstr(svg, ">divisions=32<"));
    assert_non_null(strstr(svg, ">\xE2\x89\xA4"
                                "0.01<"));
    free(svg);
}

TEST_WITH(0, any_number_of_rows_can_be_plotted, enter, leave)
{
    if (!has_gnuplot())
        skip();
    add("8", "flat", 0, 1); /* one row, without error */
    SUCCEEDS(plot("one", message));
    free(drawn("sphere"));
    add("12", "flat", NAN, 1);
    add("16", "flat", 1, 0);
    add("24", "flat", 1, NAN);
    SUCCEEDS(plot("one that counts", message));
    for (int i = 0; i < 500; i++) {
        add(formatted("%s", QUALITY_AXES[AXIS_DIVISIONS].choices[i % 14]),
            QUALITY_AXES[AXIS_INTERPOLATION].choices[i % 3], 1e6 / (i + 1), 1e-3 * (i + 1));
        results.rows[results.count - 1].quality.choice[AXIS_OUTPUT] = (unsigned char)(i % 2);
    }
    SUCCEEDS(plot("many", message));
    free(drawn("sphere"));
}

TEST_WITH(0, curves_leave_out_unknown_values, enter, leave)
{
    if (!has_gnuplot())
        skip();
    static const double x[] = {1, 2, 4, 8, 16}, y[] = {100, NAN, 1, 0, -3};
    static const double nothing[] = {NAN, NAN, NAN, NAN, NAN};
    const ReportSeries series[] = {{"one", x, y, 5}, {"none's", x, nothing, 5}, {"empty", x, y, 0}};
    for (int i = 0; i < 4; i++) {
        const ReportAxes axes = {"title", "x", "y", i % 2 == 1, i / 2 == 1, i ? "a foot" : NULL,
                                 i == 3};
        SUCCEEDS(report_curves(&axes, series, 3, "out", "curves", message));
        char *svg = drawn("curves");
        assert_non_null(strstr(svg, "none's"));
        assert_int_equal(strstr(svg, "a foot") != NULL, i > 0);
        assert_int_equal(strstr(svg, "drawn at the lower end") != NULL, i / 2 == 1);
        free(svg);
    }
}

TEST_WITH(0, gnuplot_errors_are_passed_on, enter, leave)
{
    static const char *const cases[][2] = {
        {NULL, "out/sphere.svg: plots need gnuplot: No such file or directory; install the package "
               "gnuplot-nox"},
        {"#!/bin/sh\nprintf 'a\\n\\n  line 3: bad thing\\n' >&2; exit 3\n",
         "out/sphere.svg: gnuplot: status 3:   line 3: bad thing"},
        {"#!/bin/sh\nkill -KILL $$\n", "out/sphere.svg: gnuplot: Killed"},
        {"#!/bin/sh\nexit 0\n", "out/sphere.svg: gnuplot: status 0: it drew nothing"},
        {"#!/bin/sh\nexec 0<&-; printf cut; exit 1\n",
         "out/sphere.svg: gnuplot: status 1: it drew nothing"},
    };
    char *before = strdup(getenv("PATH"));
    add_four();
    assert_int_equal(mkdir("bin", 0777), 0);
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        if (cases[i][0]) {
            testing_put("bin/gnuplot", cases[i][0]);
            assert_int_equal(chmod("bin/gnuplot", 0755), 0);
        }
        setenv("PATH", "bin", 1);
        FAILS(plot("title", message), cases[i][1]);
        setenv("PATH", before, 1);
        assert_int_equal(testing_entries("out"), 0);
    }
    free(before);
}

TEST_WITH(0, a_plot_without_a_folder_is_refused, enter, leave)
{
    if (!has_gnuplot())
        skip();
    add_four();
    FAILS_WITH(report_plot(&results, "sphere", "", "nowhere", message),
               "nowhere/sphere.svg: the folder nowhere/ does not exist");
    FAILS_WITH(report_curves(&(ReportAxes){"", "", "", false, false, NULL, false}, NULL, 0, "out",
                             "../x", message),
               "../x: cannot be a file's name");
}

/* Sheets. */

enum { SIDE = 16, SCALE = 20, PANEL = SIDE * SCALE, TOP = 32 };

static bool sheet(const Image *image, const Reference *exact, const char *caption, Message *message)
{
    return report_sheet(image, exact, caption, "sheet.png", message);
}

/* The pixel of a sheet that shows (x, y) in a panel. */
static const unsigned char *shown(const Image *image, int panel, int x, int y)
{
    const int left = 10 + panel * (PANEL + 10) + x * SCALE + SCALE / 2;
    const int top = TOP + y * SCALE + SCALE / 2;
    return (const unsigned char *)image->pixels + 4 * (top * image->width + left);
}

static int brightness(const unsigned char *pixel)
{
    return 2 * pixel[0] + 7 * pixel[1] + pixel[2];
}

static Image read_png(const char *path)
{
    png_image png = {.version = PNG_IMAGE_VERSION};
    Image image;
    assert_true(png_image_begin_read_from_file(&png, path));
    png.format = PNG_FORMAT_RGBA;
    SUCCEEDS(image_open(&image, (int)png.width, (int)png.height, IMAGE_BYTE, message));
    assert_true(png_image_finish_read(&png, NULL, image.pixels, 0, NULL));
    return image;
}

TEST_WITH(0, a_sheet_shows_what_is_different, enter, leave)
{
    Image image, read;
    float colors[3 * SIDE * SIDE];
    const Reference exact = {.width = SIDE, .height = SIDE, .color = colors};
    static const double steps[SIDE] = {0, 0.3, 0.5, 0.6, 1, 1.5, 2, 3, 5, 8, 10, 20, 50, 90, 120};
    for (int type = IMAGE_BYTE; type <= IMAGE_FLOAT; type++) {
        SUCCEEDS(image_open(&image, SIDE, SIDE, (ImageType)type, message));
        for (size_t i = 0; i < SIDE * SIDE; i++)
            for (size_t c = 0; c < 3; c++) {
                const double more = c == i % 3 ? steps[i % SIDE] / 255 : 0;
                colors[3 * i + c] = (float)(100.0 / 255 + more);
                if (type == IMAGE_BYTE)
                    ((unsigned char *)image.pixels)[4 * i + c] = 100;
                else
                    ((float *)image.pixels)[4 * i + c] = 100.0f / 255;
            }
        /* As bright as can be shown, and brighter: the same to the eye. */
        const size_t bright = SIDE * SIDE - 1;
        for (size_t c = 0; c < 3; c++) {
            colors[3 * bright + c] = 1;
            if (type == IMAGE_BYTE)
                ((unsigned char *)image.pixels)[4 * bright + c] = 255;
            else
                ((float *)image.pixels)[4 * bright + c] = 1.5f;
        }
        if (type == IMAGE_FLOAT)
            ((float *)image.pixels)[4 * 15] = NAN;
        SUCCEEDS(sheet(&image, &exact,
                       "A caption, rather long, so that it has to be broken at some "
                       "blank; it is broken there, and goes on below, to its end, "
                       "which comes here.\nAnd another line.",
                       message));
        image_close(&image);
        read = read_png("sheet.png");
        assert_int_equal(read.width, 3 * PANEL + 40);
        assert_int_equal(shown(&read, 0, 3, 3)[0], 100);
        assert_int_equal(shown(&read, 1, 0, 0)[0], 100);
        assert_int_equal(shown(&read, 1, 12, 0)[0], 150); /* 12 % 3: red */
        assert_int_equal(shown(&read, 1, 13, 0)[1], 190);
        const unsigned char *neutral = shown(&read, 2, 0, 0);
        for (int x = 1; x <= 2; x++)
            assert_memory_equal(shown(&read, 2, x, 0), neutral, 3);
        assert_memory_equal(shown(&read, 2, SIDE - 1, SIDE - 1), neutral, 3);
        for (int x = 3; x < 14; x++) {
            assert_memory_not_equal(shown(&read, 2, x, 0), neutral, 3);
            assert_true(brightness(shown(&read, 2, x, 0)) < brightness(shown(&read, 2, x + 1, 0)));
        }
        if (type == IMAGE_FLOAT)
            assert_memory_equal(shown(&read, 2, 15, 0), "\xFF\x00\xFF", 3);
        image_close(&read);
    }
}

TEST_WITH(0, pictures_of_two_sizes_make_no_sheet, enter, leave)
{
    CLOSED(image_close) Image image;
    float colors[3] = {0};
    const Reference exact = {.width = 1, .height = 1, .color = colors};
    SUCCEEDS(image_open(&image, 2, 1, IMAGE_BYTE, message));
    FAILS(sheet(&image, &exact, "", message),
          "sheet.png: the drawn picture has 2x1 pixels, the exact one 1x1");
    image.width = 1;
    assert_true(sheet(&image, &exact, "", NULL)); /* the smallest, without a caption */
}

TEST(a_cost_within_the_noise_has_no_number)
{
    static const struct {
        double cost, noise;
        const char *text;
    } cases[] = {
        {-0.9, 0.37, "too noisy to tell"},  {-0.1, 0.2, "within the noise"},
        {0.2, 0.2, "within the noise"},     {0.21, 0.2, "+21% (noise 20%)"},
        {-0.3, 0.015, "-30% (noise 2%)"},   {0.5, NAN, "too noisy to tell"},
        {0.032, 0.028, "within the noise"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const HardResult result = {.cost = cases[i].cost, .noise = cases[i].noise};
        char text[HARD_COST_SIZE];
        hard_cost_text(&result, text);
        assert_string_equal(text, cases[i].text);
    }
}

TEST_MAIN("report", NULL, NULL)
