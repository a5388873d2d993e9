/*
 * Model files that are not valid are refused with one line, and damaged ones do no harm.
 */
#include "base/plugin.h"
#include "scene/model_files.h"

#include <errno.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static unsigned short seed[3];

static void assert_refusal(const char *path, const Mesh *mesh, const Message *message)
{
    const size_t length = strlen(path);
    topology_check_zeroed(mesh);
    assert_memory_equal(message->text, path, length);
    assert_memory_equal(message->text + length, ": ", 2);
    assert_true(message->text[length + 2] && !strchr(message->text, '\n'));
}

static void assert_says(const char *path, const char *reason)
{
    Mesh mesh;
    Message message = {0};
    memset(&mesh, 0xa5, sizeof mesh);
    assert_false(model_read(path, MODEL_UP_FILE, &mesh, &message));
    assert_refusal(path, &mesh, &message);
    if (!strstr(message.text, reason))
        fail_msg("\"%s\" does not say \"%s\"", message.text, reason);
}

static void assert_refused(const char *name, Bytes bytes, const char *reason)
{
    testing_write(name, bytes.data, bytes.size);
    assert_says(name, reason);
    assert_int_equal(unlink(name), 0);
}

TEST(a_path_that_is_not_a_file_is_refused)
{
    assert_says("missing.obj", "No such file");
    assert_says("no/folder.obj", "No such file");
    assert_says("", "No such file");
    const char *path = "what.obj";
    assert_int_equal(mkdir(path, 0700), 0);
    assert_says(path, "is a folder");
    assert_int_equal(rmdir(path), 0);
    assert_int_equal(mkfifo(path, 0600), 0);
    assert_says(path, "is not a file");
    assert_int_equal(unlink(path), 0);
    assert_int_equal(symlink(path, path), 0);
    assert_says(path, "symbolic links");
    assert_int_equal(unlink(path), 0);
    assert_says("/dev/null", "is not a file");
}

TEST(a_file_that_is_not_a_model_is_refused)
{
    static const char *const names[] = {"none.obj",  "none.ply", "none.stl", "none.off",
                                        "none.gltf", "none.glb", "none.3ds", "none.dae",
                                        "none.fbx",  "none.xyz", "none"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        static const char *const contents[] = {"", "This is no model, whatever its name says.\n",
                                               "\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n\n"};
        for (int c = 0; c < 3; c++)
            assert_refused(names[i], text(contents[c]), c == 0 ? ": is empty" : ": ");
    }
}

TEST(invalid_models_are_rejected)
{
    static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                              "property float y\nproperty float z\nelement face 1\n"
                              "property list uchar int vertex_indices\nend_header\n";
    static const char *const faces[] = {"3 0 1 7", "3 0 1 1.5", "-3 0 1 2"};
    char face_ply[3][512];
    for (int i = 0; i < 3; i++)
        snprintf(face_ply[i], 512, "%s0 0 0\n1 0 0\n0 1 0\n%s\n", ply, faces[i]);
    const char *count_ply = formatted("%s0 0 0\n1 0 0\n", ply);
    const struct {
        const char *name, *content, *reason;
    } known[] = {
        {"nan.obj", "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ": position ("},
        {"inf.obj", "v 0 0 inf\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", ": position ("},
        {"big.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n", ": position ("},
        {"polygon.obj", "v 0 0 0\nv 1 0 0\nv nan 1 0\nv 1 2 0\nv 0 2 0\nf 1 2 3 4 5\n",
         ": position ("},
        {"normal.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn nan 0 0\nf 1//1 2//1 3//1\n", ": normal ("},
        {"range.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", ": cannot read: "},
        {"below.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", ": cannot read: "},
        {"huge.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4294967297\n", ": cannot read: "},
        {"range.ply", face_ply[0], ": cannot read: a face names a vertex that is none of the 3"},
        {"between.ply", face_ply[1], ": cannot read: a face names a vertex that is none of the 3"},
        {"negative.ply", face_ply[2], ": cannot read: a list has a negative length within face 1"},
        {"endless.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", ": cannot read: its header"},
        {"count.ply", count_ply, ": "},
        {"flat.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float y\nend_header\n",
         ": cannot read: its vertices need x, y and z"},
        {"fewer.ply", "ply\nformat ascii 1.0\nelement vertex -1\n",
         ": cannot read: line 3: element"},
        {"part.ply", "ply\nformat ascii 1.0\nelement vertex 3.5\n",
         ": cannot read: line 3: element"},
        {"faceless.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n", ": "},
        {"lines.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\nl 2 3\n", ": holds no triangle"},
        {"thin.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 1 1\n", ": holds no triangle"},
        {"scene.gltf", "{\"asset\":{\"version\":\"2.0\"}}", ": cannot read: "},
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        assert_refused(known[i].name, text(known[i].content), known[i].reason);
}

/* Wherever it is cut behind its header. */
TEST(a_ply_file_that_was_cut_is_rejected)
{
    const Bytes whole[] = {file("octahedron.ply"), file("square_bytes.ply")};
    for (int i = 0; i < 2; i++) {
        const char *end = strstr((const char *)whole[i].data, "end_header\n") + 11;
        const size_t header = (size_t)(end - (const char *)whole[i].data);
        /* Without its line feed text is still whole. */
        for (size_t size = header; size < whole[i].size - (i == 0); size += 7) {
            Bytes cut = whole[i];
            cut.size = size;
            assert_refused("cut.ply", cut, ": cannot read: the file ends within ");
        }
    }
}

TEST(oversized_models_are_rejected)
{
    const char *path = "large.stl";
    /* More bytes than are read; a sparse file. */
    testing_write(path, "", 0);
    assert_int_equal(truncate(path, (off_t)MODEL_BYTES_MAX + 1), 0);
    assert_says(path, ": 1073741825 bytes; model files of at most 1073741824 are read");
    /* More vertices: a header that says so, then zeros. */
    const uint32_t triangles = MODEL_VERTICES_MAX / 3 + 1;
    Bytes header = {.size = 80};
    append(&header, &triangles, sizeof triangles);
    testing_write(path, header.data, header.size);
    assert_int_equal(truncate(path, 84 + 50 * (off_t)triangles), 0);
    assert_says(path, ": cannot read: 10000002 vertices and 3333334 triangles; at most 10000000 "
                      "and 20000000 are read");
    assert_int_equal(unlink(path), 0);
}

/* Damage. */

/* A damaged file is rejected (true), or what is left is a valid mesh. */
static bool refused_or_sound(const char *name, const Bytes *bytes)
{
    Mesh mesh;
    Message message = {0};
    const bool read = read_bytes(name, bytes, &mesh, &message);
    if (read)
        assert_sound(&mesh);
    else
        assert_refusal(name, &mesh, &message);
    mesh_close(&mesh);
    return !read;
}

TEST(damaged_files_are_harmless)
{
    enum { CUTS = 12 };
    const int flips = testing_part(50, 15);
    /* Of some files the reader takes all the time that it is given. */
    const int cuts = testing_part(CUTS, 12);
    const struct {
        const char *name;
        Bytes bytes;
    } files[] = {{"damaged.obj", file("cube.obj")},
                 {"damaged.ply", file("octahedron.ply")},
                 {"bytes.ply", file("square_bytes.ply")},
                 {"damaged.stl", file("square.stl")},
                 {"bytes.stl", file("square_bytes.stl")},
                 {"damaged.gltf", gltf("[{\"mesh\":0}]", POSITION)}};
    enum { FILES = sizeof files / sizeof files[0] };
    struct rlimit before, after;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    assert_false(refused_or_sound(files[0].name, &files[0].bytes));
    const int open_before = testing_open_files();
    for (int f = 0; f < FILES; f++) {
        int refused_cuts = 0, refused_flips = 0;
        for (int i = 0; i < cuts; i++) {
            Bytes cut = files[f].bytes;
            cut.size = cut.size * (size_t)i / (size_t)cuts;
            refused_cuts += refused_or_sound(files[f].name, &cut);
        }
        for (int i = 0; i < flips; i++) {
            Bytes flipped = files[f].bytes;
            const size_t bit = (size_t)(erand48(seed) * 8 * (double)flipped.size);
            flipped.data[bit / 8] ^= (unsigned char)(1 << bit % 8);
            refused_flips += refused_or_sound(files[f].name, &flipped);
        }
        print_message("%s: refused %d of %d cut and %d of %d with one wrong bit\n", files[f].name,
                      refused_cuts, cuts, refused_flips, flips);
        assert_true(refused_cuts > 0);
    }
    /* No file and no process is left open, and the readers' limits do not apply to this process. */
    assert_int_equal(testing_open_files(), open_before);
    assert_int_equal(waitpid(-1, NULL, 0), -1);
    assert_int_equal(errno, ECHILD);
    assert_int_equal(getrlimit(RLIMIT_AS, &after), 0);
    assert_memory_equal(&after, &before, sizeof after);
}

/* The header never ends: Assimp 5.2, which takes it for PLY by its first line, searches for its end
 * without a limit. */
TEST(a_file_that_never_ends_times_out)
{
    assert_refused("endless.model",
                   text("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"), "");
}

TEST(a_missing_plugin_names_its_package)
{
    Plugin none = {"no_such_module.so", "variable", "Nothing", "", "libnothing-dev", NULL};
    Message message = {0};
    assert_null(plugin_open(&none, &message));
    assert_memory_equal(message.text, "Nothing: its module cannot be loaded (", 38);
    assert_non_null(strstr(message.text, "no_such_module.so"));
    assert_non_null(strstr(message.text, "; install the package libnothing-dev and build again"));
    Plugin wrong = {"model_assimp.so", "no_such_variable", "Assimp", "", "libassimp-dev", NULL};
    message = (Message){0};
    assert_null(plugin_open(&wrong, &message));
    assert_memory_equal(message.text, "Assimp: ", 8);
    assert_non_null(strstr(message.text, "no_such_variable"));
}

int main(void)
{
    testing_seed48(seed);
    Plugin plugin = {PLUGIN_MODELS};
    if (!plugin_probe(&plugin, NULL))
        return EXIT_SKIPPED;
    return testing_run(0, "model, refused", testing_enter_folder, testing_leave_empty_folder);
}
