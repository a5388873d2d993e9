/*
 * class: names, verdicts from the sandbox, which result stays, and that students' text is escaped.
 */
#include "labs/class/class_find.h"
#include "labs/class/class_report.h"
#include "labs/class/class_store.h"
#include "labs/sandbox/bundle.h"
#include "labs/sandbox/sandboxed_check.h"
#include "labs/submission/verdict_json.h"
#include "support/testing.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

static Message message;
static Bundle bundle;

static int start(void **state)
{
    (void)state;
    message.text[0] = '\0';
    bundle_close(&bundle);
    return 0;
}

/* Names. */

TEST_WITH(0, names_of_people_and_platforms_are_read, start, NULL)
{
    static const struct {
        const char *entry, *student, *id, *file;
    } names[] = {
        {"mueller_anna/", "mueller_anna", "", ""},
        {"4711/", "4711", "4711", ""},
        {"mueller_anna_123456/", "mueller_anna", "123456", ""},
        {"Anna M\xC3\xBCller_123456_assignsubmission_file_/", "Anna M\xC3\xBCller", "123456", ""},
        {"Anna_12_assignsubmission_file/", "Anna", "12", ""},
        {"Anna_12_assignsubmission_file_lab05.frag", "Anna", "12", "lab05.frag"},
        {"muelleranna_123_456_lab05.frag", "muelleranna", "123", "lab05.frag"},
        {"muelleranna_LATE_123_456_lab05-2.frag", "muelleranna", "123", "lab05.frag"},
        {"muelleranna_123_456_my_lab.zip", "muelleranna", "123", ""},
        {"mueller_anna.tar.gz", "mueller_anna", "", ""},
        {"mueller_anna_lab05.frag", "mueller_anna", "", "lab05.frag"},
        {"a\xFF_b/", "a?_b", "", ""},                /* not UTF-8 */
        {"a\xE2\x80\xAEgpj.b/", "a?gpj.b", "", ""},  /* from right to left */
        {"a\xE2\x80\x93/", "a\xE2\x80\x93", "", ""}, /* a dash */
        {".DS_Store", NULL, "", ""},
        {"grades.csv", NULL, "", ""},
        {"lab05.frag", NULL, "", ""},
        {"Thumbs.db", NULL, "", ""},
        {"._mueller.zip", NULL, "", ""},
        {"__MACOSX/", NULL, "", ""},
        {"Anna_12_assignsubmission_onlinetext_/", NULL, "", ""},
    };
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char entry[100];
        ClassName name;
        snprintf(entry, sizeof entry, "%.*s", (int)strcspn(names[i].entry, "/"), names[i].entry);
        const bool read = class_name_read(entry, strchr(names[i].entry, '/') != NULL, &name);
        if (read != (names[i].student != NULL) ||
            (read && (strcmp(name.student, names[i].student) != 0 ||
                      strcmp(name.id, names[i].id) != 0 || strcmp(name.file, names[i].file) != 0)))
            fail_msg("%s", names[i].entry);
    }
}

TEST_WITH(0, folders_are_safe_and_distinct, start, NULL)
{
    static const ClassName names[] = {{.student = "a b"},
                                      {.student = "a_b"},
                                      {.student = "a/b"},
                                      {.student = "../b"},
                                      {.student = "-rf"},
                                      {.student = "a", .id = "12"},
                                      {.student = "a_1", .id = "2"},
                                      {.student = "\xC3\xBC"},
                                      {.student = "Zo\xC3\xAB \xC5\x81ukasz"},
                                      {.student = "Zo_____ukasz-c30aa66a"},
                                      {.student = "\xC3\xB6"}};
    enum { COUNT = sizeof names / sizeof names[0] };
    char folders[COUNT][CLASS_FOLDER_SIZE];
    for (int i = 0; i < COUNT; i++) {
        class_name_folder(&names[i], folders[i]);
        assert_true(bundle_name_is_safe(folders[i]));
        assert_null(strchr(folders[i], '/'));
        assert_true(folders[i][0] != '.' && folders[i][0] != '-');
        for (int j = 0; j < i; j++)
            assert_string_not_equal(folders[i], folders[j]);
    }
    assert_string_equal(folders[1], "a_b");
}

/* Verdicts. */

static const char GOOD[] =
    "{\"lab\":\"lab05_per_fragment\",\"seed\":7,\"points\":7.5,\"most\":10,\"verdict\":\"wrong\","
    "\"message\":\"one\\u0007 line\\nmore\",\"details\":\"a\\nb\",\"mistakes\":"
    "[{\"name\":\"n\",\"sentence\":\"s\",\"look\":\"l\",\"sure\":0.5,\"file\":\"a.vert\",\"line\":1,"
    "\"column\":2,\"text\":\"b\",\"change\":\"c\"}],\"symptoms\":[\"x\"],"
    "\"probes\":[{\"name\":\"C\",\"set\":\"seed\",\"width\":96,\"height\":64,\"seconds\":1,"
    "\"maximum\":null,\"rms\":0.4,\"passed\":false}],\"pictures\":[\"worst.png\"],\"seconds\":0.4,"
    "\"cost\":null,\"new\":[1,2]}";

TEST_WITH(0, a_verdict_is_read, start, NULL)
{
    static Verdict verdict;
    char lab[64];
    assert_true(verdict_read(GOOD, strlen(GOOD), lab, &verdict, &message));
    assert_string_equal(lab, "lab05_per_fragment");
    assert_int_equal(verdict.kind, VERDICT_WRONG);
    assert_true(verdict.points == 7.5 && verdict.seed == 7);
    assert_string_equal(verdict.message, "one  line more"); /* always one line */
    assert_string_equal(verdict.details, "a\nb");
    assert_true(isinf(verdict.probes[0].maximum));
    assert_string_equal(verdict.picture, "worst.png");
}

/* A result of the sandbox may have as many as a list has room for, of which one is for lateness. */
TEST_WITH(0, a_verdict_has_the_labs_parts, start, NULL)
{
    static Verdict verdict;
    char bytes[2048] = "";
    const Lab lab = {.name = "lab05_per_fragment",
                     .points = {.parts = {{"p", 1}}, .part_count = 1}};
    const SandboxedCheck check = {.lab = &lab, .seed = 7};
    const char *const probes = strstr(GOOD, "\"probes\"");
    static const char *const names[] = {"", "p", "q", "ppppppppppppp"};
    for (int k = 0; k < 4; k++) {
        size_t size = 2; /* SANDBOX_WORK, SANDBOX_RESULT */
        size += (size_t)sprintf(bytes + size, "%.*s\"parts\":[", (int)(probes - GOOD), GOOD);
        for (int i = 0; names[k][i]; i++)
            size += (size_t)sprintf(
                bytes + size, "%s{\"name\":\"%c\",\"points\":0,\"most\":1,\"state\":\"wrong\"}",
                i ? "," : "", names[k][i]);
        size += (size_t)sprintf(bytes + size, "],%s", probes);
        const SandboxRun run = {.bytes = bytes, .size = size};
        assert_int_equal(sandboxed_check_end(NULL, &run, &check, &verdict, &message), k == 1);
    }
    assert_string_equal(message.text, "invalid result: it is of another lab, seed or parts");
}

TEST_WITH(0, names_of_all_mistakes_have_room, start, NULL)
{
    static Verdict verdict;
    char names[CLASS_NAMES_SIZE];
    verdict.mistake_count = VERDICT_MAX_MISTAKES;
    const size_t longest = sizeof verdict.mistakes[0].name - 1;
    for (int i = 0; i < VERDICT_MAX_MISTAKES; i++)
        memset(verdict.mistakes[i].name, 'a', longest);
    class_mistake_names(&verdict, names);
    assert_int_equal(strlen(names), VERDICT_MAX_MISTAKES * (longest + 2) - 2);
}

/* Reads GOOD with its first `old` replaced by `new`. */
static bool read_changed(const char *old, const char *new, Verdict *verdict)
{
    char lab[64], text[2048];
    const char *at = strstr(GOOD, old);
    assert_non_null(at);
    message.text[0] = '\0';
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - GOOD), GOOD, new, at + strlen(old));
    return verdict_read(text, strlen(text), lab, verdict, &message);
}

TEST_WITH(0, a_cost_is_read_whole, start, NULL)
{
    static Verdict verdict;
    assert_true(read_changed("\"cost\":null",
                             "\"cost\":{\"error\":0.5,\"time_ratio\":1.5,\"operations\":1000,"
                             "\"operations_ratio\":0.75}",
                             &verdict));
    assert_true(verdict.cost.known && verdict.cost.operations == 1000);
    assert_true(verdict.cost.operations_ratio == 0.75);
    assert_false(read_changed("\"cost\":null", "\"cost\":{\"error\":0.5}", &verdict));
}

TEST_WITH(0, invalid_verdicts_are_refused, start, NULL)
{
    static const char *const changes[][2] = {
        {"7.5", "11"},
        {"7.5", "-1"},
        {"7.5", "\"7.5\""},
        {"7.5", "1e999"},
        {"7.5", "NaN"},
        {"\"wrong\"", "\"excellent\""},
        {"\"worst.png\"", "\"../../x.png\""},
        {"\"worst.png\"", "\".png\""},
        {"\"worst.png\"", "\"a b.png\""},
        {"\"worst.png\"", "\"worst.svg\""},
        {"\"sure\":0.5", "\"sure\":2"},
        {"\"x\"", "5"},
        {"\"seed\":7", "\"seed\":7,\"seed\":7"},
        {"\"seed\":7", "\"seed\":-7"},
        {"\"cost\":null", "\"cost\":[]"},
        {"\"one\\u0007", "\"\\u0000"},
        {"\"new\":[1,2]}", "\"new\":[1,2]}}"},
        {"96", "1e7"},
        {"\"details\":\"a\\nb\",", ""},
    };
    static Verdict verdict;
    char lab[64];
    for (size_t i = 0; i < sizeof changes / sizeof changes[0]; i++) {
        if (read_changed(changes[i][0], changes[i][1], &verdict))
            fail_msg("accepted: %s", changes[i][1]);
        assert_true(message.text[0] != '\0');
    }
    for (size_t cut = 0; cut < strlen(GOOD); cut++)
        assert_false(verdict_read(GOOD, cut, lab, &verdict, NULL));
    char *large = calloc(1, VERDICT_JSON_MAX + 2);
    assert_non_null(large);
    memset(large, '[', VERDICT_JSON_MAX + 1);
    assert_false(verdict_read(large, VERDICT_JSON_MAX + 1, lab, &verdict, NULL));
    assert_false(verdict_read(large, VERDICT_JSON_MAX, lab, &verdict, NULL)); /* deep */
    free(large);
}

TEST_WITH(0, text_is_cut_between_characters, start, NULL)
{
    char text[6];
    verdict_clean(text, sizeof text, "abcd\xC3\xBC", false);
    assert_string_equal(text, "abcd");
    verdict_clean(text, sizeof text,
                  "a\xE2\x80\xAE"
                  "b",
                  false); /* right-to-left override */
    assert_string_equal(text, "ab");
}

/* Results. */

static ClassResult result_of(const char *name, uint64_t hash, bool finished, double points)
{
    ClassResult result = {.hash = hash, .finished = finished, .limit = 10, .lab = "lab05"};
    snprintf(result.student, sizeof result.student, "%s", name);
    snprintf(result.folder, sizeof result.folder, "%s", name);
    result.verdict.kind = finished ? VERDICT_WRONG : VERDICT_TIMEOUT;
    result.verdict.points = points;
    result.verdict.most = 10;
    return result;
}

TEST_WITH(0, only_what_may_change_or_is_no_worse_is_judged_again, start, NULL)
{
    const ClassResult good = result_of("a", 1, true, 8), worse = result_of("a", 1, true, 7),
                      cut = result_of("a", 1, false, 0), other = result_of("a", 2, false, 0);
    const ClassResult *const next[] = {&worse, &cut, &good, &good, &good, &other};
    const ClassResult *const old[] = {&good, &good, &worse, &cut, &good, &good};
    for (int i = 0; i < 6; i++)
        assert_int_equal(class_result_is_worse(next[i], old[i]), i < 2);
    assert_true(class_result_stands(&good, "lab05", 1, 10));
    assert_false(class_result_stands(&good, "lab06", 1, 10));
    assert_true(class_result_stands(&cut, "lab05", 1, 10));
    assert_false(class_result_stands(&cut, "lab05", 1, 20)); /* with more time */
}

TEST_WITH(0, results_are_kept_and_merged, start, NULL)
{
    static ClassStore store, other;
    bool kept;
    const ClassResult b = result_of("b", 1, true, 8), a = result_of("a", 1, true, 3),
                      better = result_of("a", 1, true, 4), cut = result_of("b", 1, false, 0);
    assert_true(class_store_open(&store, "out", NULL, &message));
    assert_false(class_store_open(&other, "out", NULL, &message)); /* locked */
    assert_non_null(strstr(message.text, "another run"));
    message.text[0] = '\0';
    assert_true(class_store_put(&store, &b, (ClassFiles){.picture = NULL}, &kept, &message) &&
                kept);
    assert_true(class_store_put(&store, &a, (ClassFiles){.picture = NULL}, &kept, &message) &&
                kept);
    assert_true(class_store_put(&store, &cut, (ClassFiles){.picture = NULL}, &kept, &message) &&
                !kept);
    class_store_close(&store);

    assert_true(class_store_open(&other, "part", NULL, &message));
    assert_true(class_store_put(&other, &better, (ClassFiles){.picture = NULL}, &kept, &message));
    assert_true(class_store_put(&other, &cut, (ClassFiles){.picture = NULL}, &kept, &message));
    class_store_close(&other);

    assert_true(class_store_open(&store, "out", NULL, &message));
    assert_int_equal(store.count, 2);
    assert_true(class_store_read(&other, "part", NULL, &message));
    assert_true(class_store_merge(&store, &other, &message));
    class_store_close(&other);
    assert_true(class_store_find(&store, "a")->verdict.points == 4);
    assert_true(class_store_find(&store, "b")->finished);
    class_store_close(&store);
}

int main(void)
{
    return testing_run(0, "class", testing_enter_folder, testing_leave_folder);
}
