/*
 * shader_files: what the cache of files keeps, and what is a change of them. No GL.
 */
#include "core/shader_folder.h"

#include <sys/stat.h>
#include <unistd.h>

static ShaderFiles kept;

/* The requested paths. */
static void asked_for(const char *const *paths, int count)
{
    for (int i = 0; i < count && i < kept.count; i++)
        assert_string_equal(kept.files[i].path, paths[i]);
    assert_int_equal(kept.count, count);
}

static void changed(const char *path)
{
    const char *found_path = shader_files_changed(&kept);
    if (!found_path)
        fail_msg("%s has not changed", path);
    assert_string_equal(found_path, path);
}

SHADER_TEST(the_cache_keeps_what_was_read_or_missed)
{
    static const char *const asked[] = {"one/a/main.vert", "one/main.vert", "one/part.glsl",
                                        "two/part.glsl", "one/more.glsl"};
    assert_int_equal(system("mkdir -p one/a two"), 0);
    make("one/main.vert", "#include \"part.glsl\"\nint a;\n");
    make("two/part.glsl", "int b;\n");
    loader.folder = "one";
    loader.files = &kept;
    setenv("LIGHTING_SHADERS", "two", 1);
    found("a/main.vert", "one/main.vert");
    text_is("#version 100\nint b;\nint a;\n");
    asked_for(asked, 4);
    assert_null(shader_files_changed(&kept));

    /* Edited, removed, and created where it would be found earlier. */
    make("one/main.vert", "int c;\n");
    assert_int_equal(unlink("two/part.glsl"), 0);
    make("one/a/main.vert", "int d;\n");
    for (int i = 0; i < 2; i++) {
        found("a/main.vert", "one/main.vert");
        text_is("#version 100\nint b;\nint a;\n");
        asked_for(asked, 4);
    }
    loader.files = NULL;
    found("a/main.vert", "one/a/main.vert");
    text_is("#version 100\nint d;\n");

    /* Files not requested before come from disk. */
    loader.files = &kept;
    make("one/more.glsl", "int e;\n");
    found("more.glsl", "one/more.glsl");
    asked_for(asked, 5);
    shader_files_close(&kept);
    assert_int_equal(kept.count, 0);
}

SHADER_TEST(only_changed_contents_are_a_change)
{
    make("main.vert", "#include \"part.glsl\"\n");
    make("part.glsl", "int b;\n");
    assert_int_equal(mkdir("sub", 0777), 0);
    loader.folder = "sub";
    loader.files = &kept;
    setenv("LIGHTING_SHADERS", ".", 1);
    found("main.vert", "./main.vert");
    static const char *const asked[] = {"sub/main.vert", "./main.vert", "./part.glsl"};
    asked_for(asked, 3);

    make("part.glsl", "int c;\n");
    changed("./part.glsl");
    make("main.vert", "int c;\n");
    changed("./main.vert");
    make("main.vert", "#include \"part.glsl\"\n");
    changed("./part.glsl");
    /* Rewritten with the same text, as another file, with another date: no change. */
    make("new", "int b;\n");
    assert_int_equal(rename("new", "part.glsl"), 0);
    assert_int_equal(chmod("part.glsl", 0600), 0);
    assert_null(shader_files_changed(&kept));
    make("part.glsl", "int b;\n ");
    changed("./part.glsl");
    testing_write("part.glsl", "int b;\n\0", 8);
    changed("./part.glsl");
    assert_int_equal(unlink("part.glsl"), 0);
    changed("./part.glsl");
    assert_int_equal(mkdir("part.glsl", 0777), 0);
    changed("./part.glsl");
    assert_int_equal(rmdir("part.glsl"), 0);
    make("part.glsl", "int b;\n");
    assert_null(shader_files_changed(&kept));
    make("sub/main.vert", "");
    changed("sub/main.vert");
    assert_int_equal(unlink("sub/main.vert"), 0);
    assert_int_equal(symlink("../main.vert", "sub/main.vert"), 0);
    changed("sub/main.vert");
    assert_int_equal(system("rm -r sub"), 0);
    assert_null(shader_files_changed(&kept)); /* it was missing before, too */
    shader_files_close(&kept);

    /* An unreadable file is unchanged while the reason is the same. */
    assert_int_equal(mkdir("folder.vert", 0777), 0);
    refused("folder.vert", "./folder.vert: is not a regular file", "");
    assert_null(shader_files_changed(&kept));
    assert_int_equal(rmdir("folder.vert"), 0);
    changed("./folder.vert");
    refused("folder.vert", "./folder.vert: is not a regular file", "");
    shader_files_close(&kept);
}

SHADER_TEST(replacements_are_cached_and_texts_in_memory_are_not)
{
    static const ShaderText texts[] = {{"made.glsl", "int m;\n"}, {NULL, NULL}};
    static const ShaderReplacement replacements[] = {{"old.glsl", "new.glsl"}, {NULL, NULL}};
    static const char *const asked[] = {"./main.vert", "./new.glsl"};
    make("main.vert", "#include \"made.glsl\"\n#include \"old.glsl\"\n");
    make("made.glsl", "int o;\n");
    make("old.glsl", "int o;\n");
    make("new.glsl", "int n;\n");
    loader.texts = texts;
    loader.replacements = replacements;
    loader.files = &kept;
    for (int i = 0; i < 2; i++) {
        found("main.vert", "./main.vert");
        text_is("#version 100\nint m;\nint n;\n");
        asked_for(asked, 2);
        make("made.glsl", "int x;\n");
        make("old.glsl", "int x;\n");
        assert_null(shader_files_changed(&kept));
        make("new.glsl", "int x;\n");
        changed("./new.glsl");
        make("new.glsl", "int n;\n");
    }
    shader_files_close(&kept);
}

SHADER_TEST(a_later_cycle_does_not_harm_the_cache)
{
    make("a.vert", "#include \"b.glsl\"\n");
    make("b.glsl", "int b;\n");
    loader.files = &kept;
    found("a.vert", "./a.vert");
    assert_int_equal(unlink("b.glsl"), 0);
    assert_int_equal(symlink("a.vert", "b.glsl"), 0);
    changed("./b.glsl");
    found("a.vert", "./a.vert");
    text_is("#version 100\nint b;\n");
    shader_files_close(&kept);
    refused("a.vert", "./", "includes itself");
    shader_files_close(&kept);
}

SHADER_TEST(a_folder_created_or_removed_is_a_change)
{
    loader = (ShaderLoader){.folder = "mine", .files = &kept};
    assert_false(shader_loader_check(&loader, NULL));
    assert_null(shader_files_changed(&kept));
    assert_int_equal(mkdir("mine", 0777), 0);
    changed("mine");
    shader_files_close(&kept);
    assert_true(shader_loader_check(&loader, NULL));
    assert_null(shader_files_changed(&kept));
    assert_int_equal(rmdir("mine"), 0);
    changed("mine");
    shader_files_close(&kept);
}

SHADER_TEST(closing_nothing_is_fine)
{
    ShaderSource empty = {0};
    shader_source_close(NULL);
    shader_source_close(&empty);
    shader_files_close(NULL);
    shader_files_close(&(ShaderFiles){0});
}

TEST_MAIN("shader files", NULL, NULL)
