/* A probe for people, and for programs. */
#include "probe/probe.h"

#include "base/json_writer.h"
#include "base/memory.h"
#include "base/output_text.h"
#include "core/shader_source.h"
#include "probe/origin.h"
#include "probe/show.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const CaptureDraw *draw_of(const Probe *probe)
{
    return &probe->question.capture->draws[probe->pixel.draw];
}

static const GlslTree *tree_of(const Probe *probe)
{
    return raster_code(probe->raster, probe->pixel.draw, 1)->tree;
}

static GlslPlace place_of(const Probe *probe, int event)
{
    return tree_of(probe)->nodes[probe->driver.events[event].node].place;
}

/* The exact run's event; NULL: it went another way. */
static const GlslEvent *exact_event(const Probe *probe, int event)
{
    const GlslEvent *exact = event < probe->exact.count ? &probe->exact.events[event] : NULL;
    return exact && exact->node == probe->driver.events[event].node ? exact : NULL;
}

static double steps_apart(const Probe *probe, const GlslEvent *event, const GlslEvent *exact)
{
    double most = 0;
    for (int k = 0; k < event->count; k++)
        most = fmax(most, fabs(probe->driver.values[event->value + k] -
                               probe->exact.values[exact->value + k]));
    return 255 * most;
}

/* "pow(base, 8.0)": what an event assigns. */
static void event_text(const Probe *probe, int event, char *text, size_t size)
{
    const GlslTree *tree = tree_of(probe);
    const int node = probe->driver.events[event].node, kind = tree->nodes[node].kind;
    glsl_expression_text(tree,
                         kind == GLSL_VARIABLE_NODE ? tree->nodes[node].first
                         : kind == GLSL_ASSIGN      ? glsl_child(tree, node, 1)
                                                    : node,
                         text, size);
}

/* " in line 15 (pow(base, 8.0))". */
static void put_event(FILE *file, const Probe *probe, int event)
{
    char place[PLACE_TEXT], text[64];
    place_name(draw_of(probe)->sources[1], place_of(probe, event), place);
    event_text(probe, event, text, sizeof text);
    fprintf(file, " in %s (%s)", place, text);
}

/* What it assigns to, or what a condition or a return computes. */
static void event_name(const Probe *probe, int event, char *text, size_t size)
{
    const int symbol = probe->driver.events[event].symbol;
    if (symbol)
        snprintf(text, size, "%s", tree_of(probe)->symbols[symbol].name);
    else
        event_text(probe, event, text, size);
}

static bool is_rounded(const Probe *probe)
{
    return probe->rounding >= SHOW_LEAST;
}

static void put_verdict(FILE *file, const Probe *probe)
{
    if (probe->question.exact && (probe->undefined || probe->otherwise))
        fprintf(file, "%.2f steps off as drawn; ", probe->as_drawn);
    if (probe->undefined) {
        fprintf(file, "the colour is undefined");
        return;
    }
    if (probe->otherwise)
        fprintf(file, "%sas computed, ", probe->question.exact ? "" : "not what is drawn; ");
    fprintf(file, "%.2f steps off: %.2f by %s, %.2f by rounding", probe->whole, probe->formula,
            probe->question.exact ? "the formula" : "interpolation", probe->rounding);
    if (!is_rounded(probe))
        return;
    fprintf(file, ", born");
    if (probe->birth < 0)
        fprintf(file, " in the vertex shader");
    else
        put_event(file, probe, probe->birth);
    if (probe->magnifier >= 0) {
        fprintf(file, ", magnified %.3g times", probe->magnified);
        put_event(file, probe, probe->magnifier);
    }
}

/* Text */

static void put_numbers(FILE *file, const double *values, int count)
{
    for (int i = 0; i < count && i < 4; i++)
        fprintf(file, "%s%.7g", i ? ", " : "", values[i]);
    fprintf(file, count > 4 ? ", ..." : "");
}

static void put_steps(FILE *file, const char *name, const double color[3])
{
    for (int i = 0; i < 3; i++)
        fprintf(file, isnan(color[i]) ? "%s no number" : "%s %.3f", i ? "," : name,
                origin_step(color[i]));
}

/* What a variable, or an element of an array, holds before an event; returns how many numbers, 0:
 * it is not known, or no vector. */
static int value_before(const Probe *probe, int event, const char *name, double value[4])
{
    const GlslRun *run = probe->run;
    GlslVariable found;
    for (int i = event - 1; i >= 0; i--) {
        const GlslEvent *at = &probe->driver.events[i];
        const GlslSymbol *symbol = &tree_of(probe)->symbols[at->symbol];
        if (strcmp(symbol->name, name) != 0)
            continue;
        if (!glsl_is_vector(symbol->type) || at->count != glsl_size(symbol->type))
            return 0;
        memcpy(value, probe->driver.values + at->value, sizeof *value * (size_t)at->count);
        return at->count;
    }
    if (!glsl_find(run->code, name, &found) || !glsl_is_vector(found.type))
        return 0;
    memcpy(value, run->registers + found.first, sizeof *value * (size_t)found.count);
    return found.count;
}

/* Writes the value of the variable at the beginning of a text, with index and components; returns
 * where the text goes on; NULL: it is not known. */
static const char *put_value(FILE *file, const Probe *probe, int event, const char *text)
{
    static const char NAME[] = "_0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    char name[CAPTURE_NAME], index[CAPTURE_NAME];
    double value[4];
    const int length = (int)strspn(text, NAME);
    snprintf(name, sizeof name, "%.*s", length, text);
    text += length;
    const int inside = *text == '[' ? (int)strspn(text + 1, NAME) : 0;
    if (inside && text[1 + inside] == ']') {
        snprintf(index, sizeof index, "%.*s", inside, text + 1);
        snprintf(name, sizeof name, "%.*s[%d]", length, text - length,
                 value_before(probe, event, index, value) == 1 ? (int)value[0] : atoi(index));
        text += inside + 2;
    }
    const int count = value_before(probe, event, name, value);
    if (count == 0 || *text == '(' || *text == '[')
        return NULL;
    const int chosen = *text == '.' ? (int)strspn(text + 1, NAME) : 0;
    fprintf(file, chosen != 1 && count > 1 ? "(" : "");
    for (int i = 0; i < (chosen ? chosen : count); i++) {
        const int at = chosen ? (int)(strchr("xyzwrgbastpq", text[1 + i]) - "xyzwrgbastpq") % 4 : i;
        fprintf(file, "%s%.4g", i ? ", " : "", value[at]);
    }
    fprintf(file, chosen != 1 && count > 1 ? ")" : "");
    return text + (chosen ? chosen + 1 : 0);
}

/* What an event assigns, with the numbers in it that its variables hold: "= 0.8 * 0.5", for free();
 * NULL if it computes nothing of these. */
static char *filled_text(const Probe *probe, int event)
{
    char text[512];
    OutputText own;
    event_text(probe, event, text, sizeof text);
    output_text_open(&own);
    const char *at = text;
    bool any = false, begins = true;
    while (*at) {
        const bool letter = isalpha((unsigned char)*at) || *at == '_';
        const char *next = letter && begins ? put_value(own.file, probe, event, at) : NULL;
        any |= next != NULL;
        begins = next || !(letter || isdigit((unsigned char)*at) || *at == '.');
        if (!next)
            fputc(*at++, own.file);
        else
            at = next;
    }
    char *filled = output_text_close(&own);
    const GlslNode *node = &tree_of(probe)->nodes[probe->driver.events[event].node];
    const int op = node->kind == GLSL_ASSIGN ? node->op : GLSL_SET;
    char *said = NULL;
    if (any && node->kind != GLSL_UNARY && (op != GLSL_SET || strpbrk(text, "+-*/(")))
        said = memory_format("%s= %s",
                             op == GLSL_ADD        ? "+"
                             : op == GLSL_SUBTRACT ? "-"
                             : op == GLSL_MULTIPLY ? "*"
                             : op == GLSL_DIVIDE   ? "/"
                                                   : "",
                             filled);
    free(filled);
    return said;
}

/* The lines of a text of several files are shown, for nobody has it at hand. */
static void put_trail(FILE *file, const Probe *probe)
{
    char place[PLACE_TEXT], before[PLACE_TEXT] = "", line[PLACE_TEXT], name[PLACE_TEXT];
    fprintf(file, "line, name: driver | exact | difference in steps of 1/255\n");
    for (int i = 0; i < probe->driver.count; i++) {
        const GlslEvent *event = &probe->driver.events[i], *exact = exact_event(probe, i);
        const char *source = draw_of(probe)->sources[1];
        place_name(source, place_of(probe, i), place);
        const bool single = strncmp(place, "line ", 5) == 0;
        place_line(source, place_of(probe, i), line);
        if (!single && strcmp(place, before) != 0)
            fprintf(file, "%s  %s\n", place, line);
        memcpy(before, place, sizeof before);
        event_name(probe, i, name, sizeof name);
        fprintf(file, "%4s  %s: ", single ? place + 5 : "", name);
        put_numbers(file, probe->driver.values + event->value, event->count);
        if (exact) {
            fprintf(file, " | ");
            put_numbers(file, probe->exact.values + exact->value, exact->count);
            fprintf(file, " | %.3g\n", steps_apart(probe, event, exact));
        } else {
            fprintf(file, " | the exact one goes another way\n");
        }
        char *filled = filled_text(probe, i);
        if (filled)
            fprintf(file, "      %s\n", filled);
        free(filled);
    }
}

static bool is_handed_over(const GlslVariable *variable)
{
    return variable->storage == GLSL_VARYING || strcmp(variable->name, "gl_Position") == 0;
}

static void put_corner(FILE *file, const Probe *probe, int corner)
{
    const unsigned vertex = probe->pixel.corners[corner];
    const GlslRun *run =
        raster_vertex(probe->raster, probe->pixel.draw, vertex, raster_driver(probe->raster));
    fprintf(file, "vertex %u, weight %.6f:", vertex, probe->pixel.weights[corner]);
    for (int k = 0; k < run->code->variable_count; k++) {
        const GlslVariable *variable = &run->code->variables[k];
        if (!is_handed_over(variable))
            continue;
        fprintf(file, " %s (", variable->name);
        put_numbers(file, run->registers + variable->first, variable->count);
        fprintf(file, ")");
    }
    fprintf(file, "\n");
}

static void put_end(FILE *file, const Probe *probe)
{
    fputs(probe->remarks, file);
    if (probe->judged) {
        fprintf(file, "verdict: ");
        put_verdict(file, probe);
        fprintf(file, "\n");
    }
}

char *probe_verdict(const Probe *probe)
{
    OutputText text;
    output_text_open(&text);
    put_end(text.file, probe);
    return output_text_close(&text);
}

char *probe_text(const Probe *probe)
{
    const ProbeQuestion *question = &probe->question;
    const unsigned char *drawn = question->drawn;
    const ExactPixel *exact = question->exact;
    OutputText text;
    output_text_open(&text);
    FILE *file = text.file;
    fprintf(file, "pixel %d,%d: drawn %d, %d, %d\n", question->column, question->row, drawn[0],
            drawn[1], drawn[2]);
    if (exact) {
        const double color[3] = {(double)exact->color[0], (double)exact->color[1],
                                 (double)exact->color[2]};
        put_steps(file, "exact picture:", color);
        fprintf(file, ", %s\n%s", exact->object, exact->equation ? exact->equation : "");
    }
    if (probe->pixel.draw >= 0) {
        put_steps(file, "computed:", probe->driver.color);
        put_steps(file, "; exactly, the same text:", probe->exact.color);
        if (probe->judged && !exact)
            put_steps(file, "; at the pixel itself:", probe->picture);
        fprintf(file, "\n");
        put_trail(file, probe);
    }
    put_end(file, probe);
    if (probe->judged && is_rounded(probe) && probe->birth >= 0)
        fprintf(file, "(the line from which on the error of the colour stays when all that "
                      "follows is computed exactly)\n");
    for (int c = 0; c < 3 && probe->pixel.draw >= 0; c++)
        put_corner(file, probe, c);
    return output_text_close(&text);
}

/* JSON */

static void write_numbers(JsonWriter *json, const char *name, const double *values, int count)
{
    json_write_list(json, name);
    for (int i = 0; i < count; i++)
        json_write_number(json, NULL, values[i]);
    json_write_end(json);
}

static void write_place(JsonWriter *json, const Probe *probe, int event)
{
    char text[PLACE_TEXT];
    const GlslPlace place = place_of(probe, event);
    place_name(draw_of(probe)->sources[1], place, text);
    json_write_text(json, "place", text);
    json_write_whole(json, "line", place.line % SHADER_LINES_OF_FILE);
    place_line(draw_of(probe)->sources[1], place, text);
    json_write_text(json, "source", text);
}

static void write_trail(JsonWriter *json, const Probe *probe)
{
    json_write_list(json, "assignments");
    for (int i = 0; i < probe->driver.count; i++) {
        const GlslEvent *event = &probe->driver.events[i], *exact = exact_event(probe, i);
        json_write_object(json, NULL);
        char name[PLACE_TEXT];
        write_place(json, probe, i);
        event_name(probe, i, name, sizeof name);
        json_write_text(json, "name", name);
        char *filled = filled_text(probe, i);
        if (filled)
            json_write_text(json, "filled", filled);
        free(filled);
        write_numbers(json, "driver", probe->driver.values + event->value, event->count);
        if (exact) {
            write_numbers(json, "exact", probe->exact.values + exact->value, exact->count);
            json_write_number(json, "steps", steps_apart(probe, event, exact));
        }
        json_write_end(json);
    }
    json_write_end(json);
}

static void write_verdict(JsonWriter *json, const Probe *probe)
{
    OutputText text;
    output_text_open(&text);
    put_verdict(text.file, probe);
    char *said = output_text_close(&text);
    json_write_object(json, "verdict");
    json_write_text(json, "text", said);
    free(said);
    if (probe->undefined) {
        json_write_end(json);
        return;
    }
    json_write_number(json, "steps", probe->whole);
    write_numbers(json, "against", probe->picture, 3);
    json_write_number(json, probe->question.exact ? "formula" : "interpolation", probe->formula);
    json_write_number(json, "rounding", probe->rounding);
    json_write_whole(json, "born", probe->birth); /* which of the assignments */
    if (probe->magnifier >= 0) {
        json_write_whole(json, "magnifier", probe->magnifier);
        json_write_number(json, "magnified", probe->magnified);
    }
    json_write_end(json);
}

static void write_corner(JsonWriter *json, const Probe *probe, int corner)
{
    const unsigned vertex = probe->pixel.corners[corner];
    const GlslRun *run =
        raster_vertex(probe->raster, probe->pixel.draw, vertex, raster_driver(probe->raster));
    json_write_object(json, NULL);
    json_write_whole(json, "vertex", vertex);
    json_write_number(json, "weight", probe->pixel.weights[corner]);
    for (int k = 0; k < run->code->variable_count; k++) {
        const GlslVariable *variable = &run->code->variables[k];
        if (is_handed_over(variable))
            write_numbers(json, variable->name, run->registers + variable->first, variable->count);
    }
    for (int i = 0; i < run->event_count; i++) {
        const GlslEvent *event = &run->events[i];
        const GlslSymbol *symbol = &run->code->tree->symbols[event->symbol];
        if (event->symbol && !symbol->global && event == glsl_last(run, symbol->name) &&
            glsl_is_vector(symbol->type) && event->count == glsl_size(symbol->type))
            write_numbers(json, symbol->name, run->values + event->value, event->count);
    }
    json_write_end(json);
}

static void write_exact(JsonWriter *json, const ExactPixel *exact)
{
    const double color[3] = {(double)exact->color[0], (double)exact->color[1],
                             (double)exact->color[2]};
    write_numbers(json, "exact_picture", color, 3);
    json_write_text(json, "object", exact->object);
    if (!exact->equation)
        return;
    json_write_text(json, "equation", exact->equation);
    json_write_value(json, "terms", exact->terms);
    json_write_list(json, "directions");
    for (int i = 0; i < exact->direction_count; i++) {
        const ExactDirection *direction = &exact->directions[i];
        json_write_object(json, NULL);
        json_write_text(json, "name", direction->name);
        write_numbers(json, "vector", direction->vector, 3);
        write_numbers(json, "to", direction->to, 2); /* drawn from the pixel, in its units */
        json_write_end(json);
    }
    json_write_end(json);
}

/* Of colours 0 to 1 is the range that a framebuffer keeps. */
char *probe_json(const Probe *probe)
{
    const ProbeQuestion *question = &probe->question;
    double drawn[3];
    OutputText text;
    output_text_open(&text);
    JsonWriter json = {.file = text.file, .lines = 2};
    for (int i = 0; i < 3; i++)
        drawn[i] = question->drawn[i] / 255.0;
    json_write_object(&json, NULL);
    json_write_whole(&json, "column", question->column);
    json_write_whole(&json, "row", question->row);
    write_numbers(&json, "drawn", drawn, 3);
    if (question->exact)
        write_exact(&json, question->exact);
    if (probe->pixel.draw >= 0) {
        write_numbers(&json, "computed", probe->driver.color, 4);
        write_numbers(&json, "exact", probe->exact.color, 4);
        write_trail(&json, probe);
        json_write_list(&json, "vertices");
        for (int c = 0; c < 3; c++)
            write_corner(&json, probe, c);
        json_write_end(&json);
    }
    json_write_text(&json, "remarks", probe->remarks);
    if (probe->judged)
        write_verdict(&json, probe);
    json_write_end(&json);
    return output_text_close(&text);
}
