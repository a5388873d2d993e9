/*
 * The table of materials. No GL.
 */
#include "scene/material.h"
#include "support/testing.h"

TEST(there_are_24_materials_and_each_is_found_by_its_name)
{
    assert_int_equal(MATERIAL_COUNT, 24);
    for (int i = 0; i < MATERIAL_COUNT; i++)
        assert_ptr_equal(material_find(MATERIALS[i].name), &MATERIALS[i].material);
    assert_null(material_find("unobtainium"));
    assert_null(material_find(""));
    assert_null(material_find("Gold"));
}

TEST(materials_are_those_of_the_published_table)
{
    static const struct {
        const char *name;
        Vec3 ambient, diffuse, specular;
        double shininess; /* of 128 */
    } rows[] = {
        {"emerald", {.0215, .1745, .0215}, {.07568, .61424, .07568}, {.633, .727811, .633}, .6},
        {"pearl", {.25, .20725, .20725}, {1, .829, .829}, {.296648, .296648, .296648}, .088},
        {"brass",
         {.329412, .223529, .027451},
         {.780392, .568627, .113725},
         {.992157, .941176, .807843},
         .21794872},
        {"gold", {.24725, .1995, .0745}, {.75164, .60648, .22648}, {.628281, .555802, .366065}, .4},
        {"cyan_plastic",
         {0, .1, .06},
         {0, .50980392, .50980392},
         {.50196078, .50196078, .50196078},
         .25},
        {"yellow_rubber", {.05, .05, 0}, {.5, .5, .4}, {.7, .7, .04}, .078125},
    };
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const Material *got = material_find(rows[i].name);
        const Material expected = {rows[i].ambient, rows[i].diffuse, rows[i].specular, .alpha = 1,
                                   .shininess = 128 * rows[i].shininess};
        assert_non_null(got);
        assert_memory_equal(got, &expected, sizeof expected);
    }
}

TEST_MAIN("material", NULL, NULL)
