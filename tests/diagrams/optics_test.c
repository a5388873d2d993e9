/* The numbers of Vectors' figures against closed forms. */
#include "diagrams/usual_optics.h"

static const Vec3 UP = {0, 1, 0}, ORIGIN = {0, 0, 0};

TEST(vectors_are_what_their_angles_say)
{
    for (int light = -180; light <= 180; light += 5)
        for (int eye = -90; eye <= 90; eye += 5) {
            const Optics optics = usual(light, eye, 10, REFLECTION_PHONG);
            const OpticsVectors at = optics_vectors(&optics, ORIGIN, UP);
            assert_near(at.n_dot_l, cosine(light));
            assert_near(at.r_dot_v, cosine(eye - light));
            /* R mirrors L in N: the same along N, the opposite across. */
            assert_near(at.r.x, -at.l.x);
            assert_near(at.r.y, at.l.y);
            assert_near(vec3_length(at.r), 1);
            /* Where L and V are opposite, H is zero or, by rounding, any unit vector. */
            const bool opposite = (eye + light + 540) % 360 == 0;
            assert_near(vec3_length(at.h), opposite && vec3_length(at.h) < 0.5 ? 0 : 1);
            if (abs(eye + light) < 175) /* halfway, on the side of both */
                assert_near(at.n_dot_h, cosine((eye - light) / 2.0));
        }
}

TEST(right_angles_are_exact)
{
    const Optics optics = usual(90, 0, 10, REFLECTION_PHONG);
    const OpticsVectors at = optics_vectors(&optics, ORIGIN, UP);
    assert_true(at.n_dot_l == 0 && at.l.x == -1 && at.r.x == 1 && at.highlight == 0);
}

TEST(a_lobe_is_a_power_of_a_cosine)
{
    static const double SHININESS[] = {0, 0.5, 1, 10, 128};
    for (int i = 0; i < 5; i++)
        for (int eye = -90; eye <= 90; eye += 3) {
            const Optics phong = usual(35, 0, SHININESS[i], REFLECTION_PHONG);
            const Optics blinn = usual(35, 0, SHININESS[i], REFLECTION_BLINN_PHONG);
            assert_near(optics_lobe(&phong, eye), pow(fmax(cosine(eye - 35), 0), SHININESS[i]));
            assert_near(optics_lobe(&blinn, eye), pow(cosine((eye - 35) / 2.0), SHININESS[i]));
        }
}

TEST(a_light_behind_has_no_lobe)
{
    const Optics optics = usual(100, 100, 0, REFLECTION_PHONG);
    for (int eye = -90; eye <= 90; eye += 10)
        assert_true(optics_lobe(&optics, eye) == 0);
}

TEST(at_the_half_angle_the_highlight_is_half)
{
    for (int reflection = 0; reflection < 2; reflection++)
        for (double shininess = 4; shininess <= 128; shininess *= 2) {
            const Optics optics = usual(30, 0, shininess, (Reflection)reflection);
            const double eye = 30 - optics_half_angle(&optics);
            assert_near(optics_lobe(&optics, eye), 0.5);
        }
    const Optics flat = usual(30, 0, 0, REFLECTION_PHONG);
    assert_true(optics_half_angle(&flat) == 180);
}

TEST(a_footprint_is_the_width_over_the_cosine)
{
    assert_true(optics_footprint(1) == 1 && optics_footprint(0.5) == 2);
    assert_true(isinf(optics_footprint(0)) && isinf(optics_footprint(-0.5)));
    for (int light = 0; light < 90; light++)
        assert_near(optics_footprint(cosine(light)) * cosine(light), 1);
}

/* Emission + 0.2 ambient + diffuse N.L + specular (R.V or N.H)^s, clamped. */
TEST(colours_are_the_lighting_equation)
{
    for (int reflection = 0; reflection < 2; reflection++)
        for (int light = -175; light <= 175; light += 10) {
            const Optics optics = usual(light, 25, 20, (Reflection)reflection);
            const Material *m = optics.material;
            const double n_dot_l = cosine(light);
            const double base = reflection == REFLECTION_PHONG
                                    ? cosine(25 - light)
                                    : cosine((25 - light) / 2.0) * (abs(25 + light) < 180 ? 1 : -1);
            const double power = n_dot_l > 0 ? pow(fmax(base, 0), 20) : 0;
            const double wanted = m->emission.x + 0.2 * m->ambient.x +
                                  m->diffuse.x * fmax(n_dot_l, 0) + m->specular.x * power;
            assert_near(optics_color(&optics, ORIGIN, UP).x, fmin(wanted, 1));
        }
}

TEST(radiating_rays_come_from_the_lamp)
{
    Optics optics = usual(30, 40, 10, REFLECTION_PHONG);
    optics.radiating = true;
    const Vec3 lamp = optics_light_place(&optics);
    assert_near(vec3_length(lamp), OPTICS_LIGHT_DISTANCE);
    for (double x = -2; x <= 2; x += 0.5) {
        const OpticsVectors at = optics_vectors(&optics, (Vec3){x, 0, 0}, UP);
        assert_near(at.n_dot_l, lamp.y / hypot(lamp.x - x, lamp.y));
    }
    /* At the origin they are the parallel ones. */
    const OpticsVectors near = optics_vectors(&optics, ORIGIN, UP);
    assert_near(near.n_dot_l, cosine(30));
    assert_near(near.r_dot_v, cosine(10));
}

TEST_MAIN("optics", NULL, NULL)
