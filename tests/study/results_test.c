/*
 * results: rows survive a round trip and damaged files. front: which rows are efficient,
 * and which are not significantly faster.
 */
#include "study/measure/survey.h"
#include "study/results/results.h"
#include "support/testing.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static Message message;
static Results results;

/* The message, empty. */
static Message *fresh(void)
{
    message = (Message){0};
    return &message;
}

static ResultRow row_of(int number)
{
    ResultRow row = {.scene = "sphere",
                     .quality = quality_usual(),
                     .width = 400,
                     .height = 300,
                     .interior_rms = 0.1 + number / 3.0,
                     .interior_maximum = 1e-3 * number,
                     .all_rms = 0,
                     .all_maximum = 254.99999999999997,
                     .interior_pixels = 12345,
                     .time = 1.0 / 3,
                     .time_lower = 0.25,
                     .time_upper = 5e-324,
                     .run_times = {0.1, 0.2, 0.3},
                     .net_time = -0.01,
                     .gpu_time = NAN,
                     .noise = 0.02,
                     .vertices = -1,
                     .fragments = 123456789012,
                     .vertex_operations = 0,
                     .fragment_operations = -1,
                     .seed = 4294967295u,
                     .renderer = "llvm\"pipe\" (LLVM 15.0.6, 256 bits)",
                     .threads = "default"};
    for (int axis = 0; axis < AXIS_COUNT; axis++)
        row.quality.choice[axis] = (unsigned char)((number + axis) % QUALITY_AXES[axis].count);
    return row;
}

/* Numbers are written in the digits that come back. */
static void same_row(const ResultRow *a, const ResultRow *b)
{
    for (int i = 0; i < RESULTS_COLUMNS; i++) {
        char texts[2][RESULTS_FIELD_SIZE];
        const Column column = column_at(i);
        column_text(a, &column, texts[0]);
        column_text(b, &column, texts[1]);
        assert_string_equal(texts[0], texts[1]);
        if (column.kind > COLUMN_CHOICE)
            assert_memory_equal((const char *)a + column.offset, (const char *)b + column.offset,
                                column.size);
    }
    assert_true(quality_equal(&a->quality, &b->quality));
}

static FILE *create(const char *path)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    return file;
}

/* Reads a file, and returns what was said on standard error, the caller's to free. */
static char *read_file(const char *path, const ResultRow *like)
{
    size_t size;
    message = (Message){0};
    results_close(&results);
    fflush(stderr);
    const int saved = dup(STDERR_FILENO);
    const int said = open("said", O_CREAT | O_TRUNC | O_WRONLY, 0600);
    assert_true(saved >= 0 && said >= 0);
    dup2(said, STDERR_FILENO);
    const bool done = results_read(&results, path, like, &message);
    fflush(stderr);
    dup2(saved, STDERR_FILENO);
    close(saved);
    close(said);
    if (done != (message.text[0] == '\0'))
        fail_msg("%s: %s", path, message.text);
    return testing_read("said", &size);
}

/* Reads a file that has `count` good rows, and nothing to complain about. */
static void read_clean(const char *path, int count)
{
    char *said = read_file(path, NULL);
    assert_string_equal(message.text, "");
    assert_string_equal(said, "");
    assert_int_equal(results.count, count);
    free(said);
}

static int lines_in(const char *text)
{
    int count = 0;
    for (; *text; text++)
        count += *text == '\n';
    return count;
}

static void append(const char *path, const ResultRow *rows, int count)
{
    if (!results_append(path, rows, count, fresh()))
        fail_msg("%s: %s", path, message.text);
}

static void append_refused(const char *path, const ResultRow *row, const char *said)
{
    assert_false(results_append(path, row, 1, fresh()));
    if (!strstr(message.text, said) || strchr(message.text, '\n'))
        fail_msg("expected \"%s\" in \"%s\"", said, message.text);
}

static void read_refused(const char *path, const char *said)
{
    free(read_file(path, NULL));
    if (!strstr(message.text, said) || strchr(message.text, '\n'))
        fail_msg("expected \"%s\" in \"%s\"", said, message.text);
    assert_int_equal(results.count, 0);
}

static int leave(void **state)
{
    results_close(&results);
    return testing_leave_folder(state);
}

TEST_WITH(0, a_row_comes_back_as_it_was, testing_enter_folder, leave)
{
    ResultRow rows[14];
    for (int i = 0; i < 14; i++)
        rows[i] = row_of(i);
    append("a.csv", rows, 10);
    append("a.csv", rows + 10, 0);
    append("a.csv", rows + 10, 4);
    read_clean("a.csv", 14);
    for (int i = 0; i < 14; i++)
        same_row(&results.rows[i], &rows[i]);
    assert_ptr_equal(results_find(&results, "sphere", &rows[7].quality), &results.rows[7]);
    assert_null(results_find(&results, "cube", &rows[7].quality));
}

TEST_WITH(0, there_is_nothing_to_read_at_first, testing_enter_folder, leave)
{
    read_clean("missing.csv", 0);
    testing_write("empty.csv", "", 0);
    read_clean("empty.csv", 0);
    const ResultRow row = row_of(1);
    append("empty.csv", &row, 1);
    read_clean("empty.csv", 1);
}

/* Lines that end with CRLF, and blank ones. */
TEST_WITH(0, unusual_forms_of_a_file_are_read, testing_enter_folder, leave)
{
    size_t size;
    const ResultRow row = row_of(3);
    append("a.csv", &row, 1);
    char *text = testing_read("a.csv", &size);
    FILE *file = create("b.csv");
    for (const char *p = text; *p; p++)
        fputs(*p == '\n' ? "\r\n\r\n\n" : (const char[2]){*p}, file);
    fclose(file);
    free(text);
    read_clean("b.csv", 1);
    same_row(&results.rows[0], &row);
    append("b.csv", &row, 1);
    read_clean("b.csv", 2);
}

TEST_WITH(0, a_file_that_is_cut_anywhere_keeps_the_rows_before, testing_enter_folder, leave)
{
    size_t size;
    const ResultRow rows[2] = {row_of(1), row_of(2)}, next = row_of(5);
    append("a.csv", rows, 2);
    char *text = testing_read("a.csv", &size);
    const size_t header = (size_t)(strchr(text, '\n') - text) + 1;
    const size_t first = (size_t)(strchr(text + header, '\n') - text) + 1;
    for (size_t cut = 0; cut <= size; cut++) {
        /* A row is whole without its line break. */
        const int whole = (cut + 1 >= first) + (cut + 1 >= size);
        testing_write("cut.csv", text, cut);
        char *said = read_file("cut.csv", NULL);
        assert_string_equal(message.text, "");
        if (results.count != whole)
            fail_msg("cut at %zu: %d rows", cut, results.count);
        const bool within = cut > header && cut + 1 != first && cut != first && cut + 1 < size;
        assert_int_equal(lines_in(said), within);
        free(said);
        append("cut.csv", &next, 1);
        said = read_file("cut.csv", NULL);
        if (results.count != whole + 1)
            fail_msg("cut at %zu: %d rows after the next: %s", cut, results.count, said);
        same_row(&results.rows[whole], &next);
        free(said);
    }
    free(text);
}

/* One field of the only row becomes another text, without quotes. */
static void replaced(const char *column, const char *value)
{
    size_t size;
    ResultRow row = row_of(3);
    snprintf(row.renderer, sizeof row.renderer, "none");
    unlink("a.csv");
    append("a.csv", &row, 1);
    char *text = testing_read("a.csv", &size);
    char *names = text, *values = strchr(text, '\n') + 1;
    values[-1] = '\0';
    FILE *file = create("b.csv");
    fprintf(file, "%s\n", names);
    bool found = false;
    while (*names) {
        const size_t name = strcspn(names, ","), length = strcspn(values, ",\n");
        const bool here = strlen(column) == name && strncmp(names, column, name) == 0;
        found = found || here;
        fprintf(file, "%.*s", (int)(here ? strlen(value) : length), here ? value : values);
        names += name + (names[name] == ',');
        values += length + 1;
        fputc(*names ? ',' : '\n', file);
    }
    fclose(file);
    free(text);
    assert_true(found);
}

TEST_WITH(0, a_bad_value_is_reported_with_its_line, testing_enter_folder, leave)
{
    static const char *const bad[][2] = {
        {"scene", ""},
        {"scene", "../x"},
        {"scene", ".x"},
        {"scene", "a\tb"},
        {"divisions", "7"},
        {"divisions", ""},
        {"precision", "lowp"},
        {"width", "0"},
        {"width", ""},
        {"width", "16385"},
        {"width", "4e2"},
        {"width", "-1"},
        {"height", "+4"},
        {"interior_rms", "-1"},
        {"interior_rms", "nan"},
        {"all_rms", "inf"},
        {"all_rms", "0x1"},
        {"time", "1,5"},
        {"time", "1e999"},
        {"time", " 1"},
        {"time", "\"1"},
        {"time", "\"1\"2"},
        {"time", "1\"2\""},
        {"interior_pixels", "2147483648"},
        {"interior_pixels", "99999999999999999999999"},
        {"vertices", "1.5"},
        {"seed", ""},
        {"seed", "4294967296"},
        {"seed", "-1"},
        {"threads", ""},
        {"threads", "0123456789abcdef"},
        {"scene", "a-name-of-thirty-two-characters-"},
        {"noise", "two"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        replaced(bad[i][0], bad[i][1]);
        char *said = read_file("b.csv", NULL);
        if (results.count != 0)
            fail_msg("accepted: %s %s", bad[i][0], bad[i][1]);
        if (strncmp(said, "b.csv:2: ", 9) != 0 || lines_in(said) != 1 ||
            !strstr(said, "; skipped\n"))
            fail_msg("%s %s: %s", bad[i][0], bad[i][1], said);
        free(said);
    }
    static const char *const good[][2] = {{"gpu_time", ""}, {"vertices", ""}, {"time", "\"1.5\""},
                                          {"noise", "0"},   {"renderer", ""}, {"seed", "007"}};
    for (size_t i = 0; i < sizeof good / sizeof good[0]; i++) {
        replaced(good[i][0], good[i][1]);
        read_clean("b.csv", 1);
    }
}

TEST_WITH(0, many_broken_rows_make_few_lines, testing_enter_folder, leave)
{
    size_t size;
    const ResultRow row = row_of(1);
    append("a.csv", &row, 1);
    char *text = testing_read("a.csv", &size);
    FILE *file = create("b.csv");
    fputs(text, file);
    for (int i = 0; i < 1000; i++)
        fprintf(file, "broken %c[31m%d\n", 27, i);
    fputs(strchr(text, '\n') + 1, file);
    fclose(file);
    free(text);
    char *said = read_file("b.csv", NULL);
    assert_int_equal(results.count, 2);
    assert_int_equal(lines_in(said), 11);
    assert_non_null(strstr(said, "b.csv: 990 more broken rows; skipped\n"));
    assert_null(strchr(said, 27));
    free(said);
}

TEST_WITH(0, arbitrary_bytes_are_read_safely, testing_enter_folder, leave)
{
    size_t size;
    enum { LONG = 10 << 20 };
    const ResultRow row = row_of(1);
    append("a.csv", &row, 1);
    char *text = testing_read("a.csv", &size), *large = malloc(LONG);
    assert_non_null(large);
    static const char fillings[] = {'\0', 'a', ',', '"', '\r', '\n', '\xFF'};
    for (size_t i = 0; i < sizeof fillings; i++) {
        FILE *file = create("b.csv");
        memset(large, fillings[i], LONG);
        assert_int_equal(fwrite(text, 1, size, file), size);
        assert_int_equal(fwrite(large, 1, LONG, file), LONG);
        fputs("\n", file);
        fputs(strchr(text, '\n') + 1, file);
        fclose(file);
        char *said = read_file("b.csv", NULL);
        assert_int_equal(results.count, 2);
        assert_int_equal(lines_in(said), fillings[i] != '\n');
        free(said);
        testing_write("c.csv", large, LONG);
        read_refused("c.csv", "c.csv: is not a file of results");
        append_refused("c.csv", &row, "c.csv: is not a file of results");
    }
    free(large);
    free(text);
    assert_int_equal(truncate("b.csv", RESULTS_SIZE_MAX + 1), 0);
    read_refused("b.csv", "name another folder");
    append_refused("b.csv", &row, "name another folder");
}

TEST_WITH(0, other_kinds_of_files_are_refused, testing_enter_folder, leave)
{
    const ResultRow row = row_of(1);
    assert_int_equal(mkdir("sub", 0777), 0);
    assert_int_equal(mkfifo("pipe", 0600), 0);
    static const char *const cases[][2] = {{"sub", "sub: is a folder"},
                                           {"/dev/full", "/dev/full: is no regular file"},
                                           {"pipe", "pipe: is no regular file"}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        read_refused(cases[i][0], cases[i][1]);
        append_refused(cases[i][0], &row, cases[i][1]);
    }
    append_refused("nowhere/a.csv", &row, "make it first");
    testing_write("other.csv", "name,value\n1,2\n", 15);
    read_refused("other.csv", "name another folder");
    append_refused("other.csv", &row, "name another folder");
    ResultRow wrong = row;
    wrong.width = 0;
    append_refused("new.csv", &wrong, "width");
    read_clean("new.csv", 0);
    wrong = row;
    wrong.quality.choice[AXIS_ORDER] = 99;
    append_refused("new.csv", &wrong, "order");
}

/* In a child that permissions bind. */
static int try_without_permission(void)
{
    const ResultRow row = row_of(1);
    bool refused = testing_drop_root();
    for (int i = 0; i < 2 && refused; i++)
        refused = !(i ? results_append("a.csv", &row, 1, fresh())
                      : results_read(&results, "a.csv", NULL, fresh())) &&
                  strcmp(message.text, "a.csv: cannot read: Permission denied") == 0;
    return !refused;
}

TEST_WITH(0, a_file_without_permission_is_refused, testing_enter_folder, leave)
{
    const ResultRow row = row_of(1);
    append("a.csv", &row, 1);
    assert_int_equal(chmod("a.csv", 0), 0);
    assert_int_equal(chmod(".", 0755), 0);
    assert_int_equal(testing_in_child(try_without_permission), 0);
}

TEST_WITH(0, rows_appended_concurrently_do_not_mix, testing_enter_folder, leave)
{
    enum { PROGRAMS = 4, ROWS = 25 };
    for (int i = 0; i < PROGRAMS; i++) {
        const pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            bool done = true;
            const ResultRow row = row_of(i);
            for (int j = 0; j < ROWS; j++)
                done = done && results_append("a.csv", &row, 1, NULL);
            _exit(!done);
        }
    }
    for (int i = 0; i < PROGRAMS; i++) {
        int status = 1;
        assert_true(wait(&status) > 0);
        assert_int_equal(status, 0);
    }
    read_clean("a.csv", PROGRAMS * ROWS);
}

TEST_WITH(0, rows_of_another_machine_are_left_out_in_one_line, testing_enter_folder, leave)
{
    ResultRow rows[6];
    for (int i = 0; i < 6; i++)
        rows[i] = row_of(i);
    snprintf(rows[1].renderer, sizeof rows[1].renderer, "another");
    snprintf(rows[2].threads, sizeof rows[2].threads, "1");
    rows[3].width = 401;
    rows[4].height = 1;
    append("a.csv", rows, 6);
    char *said = read_file("a.csv", &rows[0]);
    assert_int_equal(results.count, 2);
    assert_int_equal(lines_in(said), 1);
    assert_non_null(strstr(said, "a.csv: 4 rows measured with another renderer"));
    free(said);
    read_clean("a.csv", 6);
}

TEST_WITH(0, a_driver_s_name_cannot_break_a_row, testing_enter_folder, leave)
{
    ResultRow row = row_of(1);
    snprintf(row.renderer, sizeof row.renderer, "a\nb\r\",,\x01\xFF\x7F");
    append("a.csv", &row, 1);
    char *said = read_file("a.csv", &row);
    assert_string_equal(said, "");
    assert_int_equal(results.count, 1);
    assert_string_equal(results.rows[0].renderer, "a b \",, \xFF ");
    free(said);
}

/* Front. */

/* A made-up row: its number makes its setting. */
static void add(int number, double error, double time)
{
    ResultRow row = {.scene = "s",
                     .quality = quality_usual(),
                     .interior_maximum = error,
                     .interior_rms = error,
                     .all_rms = error,
                     .time = time,
                     .run_times = {time, time, time},
                     .noise = 0.05};
    row.quality.choice[AXIS_DIVISIONS] = (unsigned char)(number % 14);
    row.quality.choice[AXIS_INTERPOLATION] = (unsigned char)(number / 14 % 3);
    row.quality.choice[AXIS_OUTPUT] = (unsigned char)(number / 42 % 3);
    results_add(&results, &row);
}

/* The front has the rows of these errors, in this order; -1: the end. */
static void front_is(const double *errors)
{
    Front front;
    int count = 0;
    front_find(&front, &results, "s", ERROR_INTERIOR_MAXIMUM);
    for (; errors[count] >= 0; count++)
        if (count >= front.count || front.rows[count]->interior_maximum != errors[count])
            fail_msg("%g is not number %d of %d", errors[count], count, front.count);
    assert_int_equal(front.count, count);
    for (int i = 0; i < front.count; i++)
        assert_false(front_ties(&front, front.rows[i]));
    for (int i = 0; i < front.tied_count; i++)
        assert_false(front_has(&front, front.tied[i]));
    front_close(&front);
    results_close(&results);
}

#define FRONT_IS(...) front_is((const double[]){__VA_ARGS__, -1})

/* As measured against each other: their times and errors, and how many unusual choices. */
static int chosen(const double rows[3][3], double noise, bool is_time)
{
    const ChooseLimit limit = {is_time, is_time ? 100 : 4, ERROR_INTERIOR_MAXIMUM};
    ResultRow made[3];
    for (int i = 0; i < 3; i++) {
        const double time = rows[i][0];
        made[i] = (ResultRow){.quality = quality_usual(),
                              .time = time,
                              .run_times = {time, time, time},
                              .noise = noise,
                              .interior_maximum = rows[i][1]};
        for (int axis = 0; axis < (int)rows[i][2]; axis++)
            made[i].quality.choice[axis] = (unsigned char)(!made[i].quality.choice[axis]);
    }
    const ResultRow *best = choose_among(made, 3, &limit);
    return best ? (int)(best - made) : -1;
}

TEST(of_tied_settings_the_usual_is_chosen)
{
    /* However much faster the median says: it is within the noise. */
    const double tied[3][3] = {{2, 1, 0}, {1.6, 1, 1}, {1.7, 1, 2}};
    assert_int_equal(chosen(tied, 0.3, false), 0);
    assert_int_equal(chosen(tied, 0.01, false), 1);
    /* The usual one is tied with the second, but surely slower than the third. */
    const double chain[3][3] = {{2, 1, 0}, {1.85, 1, 1}, {1.75, 1, 2}};
    assert_int_equal(chosen(chain, 0.1, false), 1);
    /* On a busy machine no time counts. */
    const double apart[3][3] = {{9, 1, 0}, {1, 1, 1}, {2, 1, 2}};
    assert_int_equal(chosen(apart, 0.1, false), 1);
    assert_int_equal(chosen(apart, 0.11, false), 0);
    /* Out of the budget. */
    const double inexact[3][3] = {{2, 4.1, 0}, {1.6, 4, 1}, {1.7, 1, 2}};
    assert_int_equal(chosen(inexact, 0.3, false), 1);
    assert_int_equal(chosen((const double[3][3]){{1, 5, 0}, {1, 5, 1}, {1, 5, 2}}, 0.3, false), -1);
    /* Of a time the most exact, and of those the usual. */
    assert_int_equal(chosen((const double[3][3]){{9, 1.005, 0}, {8, 1, 1}, {1, 2, 0}}, 0, true), 0);
    assert_int_equal(chosen((const double[3][3]){{9, 1.02, 0}, {8, 1, 1}, {1, 2, 0}}, 0, true), 1);
}

TEST_WITH(0, faster_is_more_than_the_noise_and_in_every_run, testing_enter_folder, leave)
{
    ResultRow a = {.time = 1, .run_times = {1, 1, 1}, .noise = 0.05}, b = a;
    assert_false(row_faster(&a, &b));
    b = (ResultRow){.time = 1.05, .run_times = {2, 2, 2}, .noise = 0.05};
    assert_false(row_faster(&a, &b)); /* not more than the noise */
    b.time = 1.051;
    assert_true(row_faster(&a, &b));
    assert_false(row_faster(&b, &a));
    b.noise = 0.06; /* the larger noise counts */
    assert_false(row_faster(&a, &b));
    b.noise = 0;
    assert_true(row_faster(&a, &b));
    for (int run = 0; run < RESULT_RUNS; run++) {
        ResultRow c = b;
        c.run_times[run] = 0.9;
        assert_false(row_faster(&a, &c) || row_faster(&c, &a));
        c.run_times[run] = 1;
        assert_false(row_faster(&a, &c));
        c.run_times[run] = NAN;
        assert_false(row_faster(&a, &c) || row_faster(&c, &a));
    }
    b.noise = NAN;
    assert_false(row_faster(&a, &b) || row_faster(&b, &a));
    b.noise = 0;
    b.time = NAN;
    assert_false(row_faster(&a, &b) || row_faster(&b, &a));
}

TEST_WITH(0, the_front_has_what_no_other_beats, testing_enter_folder, leave)
{
    FRONT_IS(-1); /* no rows */
    add(0, 3, 1);
    FRONT_IS(3);
    add(0, 3, 1), add(1, 2, 2), add(2, 1, 3), add(3, 2.5, 2.5), add(4, 1, 9), add(5, 4, 1.5);
    FRONT_IS(3, 2, 1);
    add(0, 0, 5), add(1, 0, 4), add(2, 1, 2); /* errors of zero */
    FRONT_IS(1, 0);
    add(0, 0, 0), add(1, 1, 0); /* and times */
    FRONT_IS(0);
}

TEST_WITH(0, among_tied_rows_the_most_exact_counts, testing_enter_folder, leave)
{
    for (int i = 0; i < 14; i++)
        add(i, 14 - i, 1 + 0.003 * i); /* within the noise of each other */
    FRONT_IS(1);
    /* A chain: each is tied with its neighbours, the first faster than the last. */
    add(0, 3, 1.00), add(1, 2, 1.04), add(2, 1, 1.08);
    FRONT_IS(3, 1);
    /* Those that the medians alone would take are called tied. */
    Front front;
    add(0, 3, 1.00), add(1, 2, 1.02), add(2, 1, 1.04), add(3, 2.5, 1.03);
    front_find(&front, &results, "s", ERROR_INTERIOR_MAXIMUM);
    assert_int_equal(front.count, 1);
    assert_int_equal(front.tied_count, 2);
    assert_true(front.tied[0]->interior_maximum == 2 && front.tied[1]->interior_maximum == 3);
    front_close(&front);
    results_close(&results);
    /* One run disagrees. */
    add(0, 3, 1), add(1, 2, 2);
    results.rows[0].run_times[1] = 2.5;
    FRONT_IS(2);
}

TEST_WITH(0, nearly_equal_errors_count_as_equal, testing_enter_folder, leave)
{
    add(0, 0.5, 3), add(1, 0.505, 2);
    FRONT_IS(0.505);
    add(0, 0.5, 3), add(1, 0.511, 2);
    FRONT_IS(0.511, 0.5);
    add(0, 0.5, 4), add(1, 0.507, 3), add(2, 0.514, 2); /* 0.014 apart is not equal */
    FRONT_IS(0.514, 0.5);
    /* Of rows that are equal in both, the most usual one. 7 divisions is the usual number. */
    add(8, 0.500, 2), add(7, 0.504, 2.01), add(22, 0.501, 1.99);
    FRONT_IS(0.504);
}

TEST_WITH(0, unknown_values_are_not_in_the_front, testing_enter_folder, leave)
{
    add(0, NAN, 1), add(1, 2, NAN), add(2, 1, 3), add(3, INFINITY, 0.1), add(4, 0, INFINITY);
    FRONT_IS(1);
    add(0, NAN, 1), add(1, 2, NAN);
    FRONT_IS(-1);
    add(0, 1, 5), add(1, 2, 3), add(0, 3, 1); /* the latest of a setting */
    FRONT_IS(3, 2);
}

/* Rows of the front do not beat each other; every other row is beaten. */
TEST_WITH(0, no_row_of_a_random_front_is_beaten, testing_enter_folder, leave)
{
    srand(1);
    for (int round = 0; round < 300; round++) {
        Front front;
        const int count = 1 + rand() % 100;
        for (int i = 0; i < count; i++) {
            const int coarse = 1 << rand() % 10;
            add(i, (rand() % (100 * coarse)) / (100.0 * coarse), 1 + rand() % 500 / 1000.0);
            ResultRow *row = &results.rows[i];
            for (int run = 0; run < RESULT_RUNS; run++)
                row->run_times[run] = row->time * (0.99 + rand() % 100 / 5000.0);
            row->noise = rand() % 50 / 1000.0;
        }
        front_find(&front, &results, "s", ERROR_INTERIOR_RMS);
        assert_true(front.count > 0);
        for (int i = 0; i < front.count; i++)
            for (int j = 0; j < front.count; j++)
                assert_true(i == j || !row_beats(front.rows[i], front.rows[j], ERROR_INTERIOR_RMS));
        for (int i = 0; i < front.count; i++)
            for (int j = i + 1; j < front.count; j++)
                assert_true(row_faster(front.rows[i], front.rows[j]));
        for (int i = 0; i < results.count; i++) {
            bool beaten = front_has(&front, &results.rows[i]);
            for (int j = 0; j < front.count; j++)
                beaten = beaten || row_beats(front.rows[j], &results.rows[i], ERROR_INTERIOR_RMS);
            assert_true(beaten);
        }
        front_close(&front);
        results_close(&results);
    }
}

TEST_MAIN("results", NULL, NULL)
