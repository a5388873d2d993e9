#include "scene/model_files.h"

#include "base/output_text.h"

#include <unistd.h>

Bytes text(const char *text)
{
    Bytes bytes = {.size = strlen(text)};
    assert_true(bytes.size <= sizeof bytes.data);
    memcpy(bytes.data, text, bytes.size);
    return bytes;
}

void append(Bytes *bytes, const void *data, size_t size)
{
    assert_true(bytes->size + size <= sizeof bytes->data);
    memcpy(bytes->data + bytes->size, data, size);
    bytes->size += size;
}

Bytes file(const char *name)
{
    Bytes bytes = {.size = 0};
    size_t size;
    char *read = testing_read(testing_source(formatted("tests/scene/models/%s", name)), &size);
    append(&bytes, read, size);
    free(read);
    return bytes;
}

bool read_bytes(const char *name, const Bytes *bytes, Mesh *mesh, Message *message)
{
    testing_write(name, bytes->data, bytes->size);
    memset(mesh, 0xa5, sizeof *mesh);
    const bool read = model_read(name, MODEL_UP_FILE, mesh, message);
    assert_int_equal(unlink(name), 0);
    return read;
}

void assert_sound(const Mesh *mesh)
{
    assert_true(mesh->index_count > 0);
    topology_check_sound(mesh);
    for (size_t i = 0; i < mesh->index_count / 3; i++) {
        Vec3 normal;
        assert_true(mesh_face(mesh, i, &normal));
    }
}

Bytes filled(const char *name, TemplateValues *values)
{
    OutputText form;
    Bytes bytes = {.size = 0};
    const char *path = formatted("tests/scene/models/%s", name);
    output_text_open(&form);
    SUCCEEDS(template_print(path, values, form.file, message));
    char *made = output_text_close(&form);
    append(&bytes, made, form.size);
    free(made);
    template_close(values);
    return bytes;
}

Bytes gltf(const char *nodes, const char *attributes)
{
    TemplateValues *values = template_values();
    template_set(values, "nodes", "%s", nodes);
    template_set(values, "attributes", "%s", attributes);
    return filled("tetrahedron.gltf", values);
}
