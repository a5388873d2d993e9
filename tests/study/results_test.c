/*
 * results: rows survive a round trip and damaged files.
 */
#include "study/results/results.h"
#include "support/testing.h"

#include <fcntl.h>
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
    static const struct {
        const char *column, *texts[7];
    } bad[] = {
        {"scene", {"", "../x", ".x", "a\tb", "a-name-of-thirty-two-characters-"}},
        {"divisions", {"7", ""}},
        {"precision", {"lowp"}},
        {"width", {"0", "", "16385", "4e2", "-1"}},
        {"height", {"+4"}},
        {"interior_rms", {"-1", "nan"}},
        {"all_rms", {"inf", "0x1"}},
        {"time", {"1,5", "1e999", " 1", "\"1", "\"1\"2", "1\"2\""}},
        {"interior_pixels", {"2147483648", "99999999999999999999999"}},
        {"vertices", {"1.5"}},
        {"seed", {"", "4294967296", "-1"}},
        {"threads", {"", "0123456789abcdef"}},
        {"noise", {"two"}},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++)
        for (const char *const *text = bad[i].texts; *text; text++) {
            replaced(bad[i].column, *text);
            char *said = read_file("b.csv", NULL);
            if (results.count != 0 || strncmp(said, "b.csv:2: ", 9) != 0 || lines_in(said) != 1 ||
                !strstr(said, "; skipped\n"))
                fail_msg("%s %s: %d rows: %s", bad[i].column, *text, results.count, said);
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

TEST_MAIN("results", NULL, NULL)
