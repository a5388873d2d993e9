/*
 * template: values, sections and remarks; a mistake in a template is one line that says where.
 */
#include "base/template.h"
#include "support/testing.h"

#include <unistd.h>

/* Two people, the second without a name for a cat. */
static TemplateValues *page(void)
{
    TemplateValues *values = template_values();
    template_set(values, "title", "%d < %s & \"%c\"'>\a", 1, "2", 'x');
    template_set(values, "empty", "%s", "");
    for (int i = 0; i < 2; i++) {
        TemplateValues *person = template_add(values, "person");
        template_set(person, "name", "%s", i ? "Bo" : "Ann");
        if (i == 0)
            template_set(template_add(person, "cat"), "called", "Tom");
    }
    return values;
}

static Message message;

/* NULL: a message. The caller frees it. */
static char *filled(const char *text)
{
    char *result = NULL;
    size_t size;
    TemplateValues *values = page();
    FILE *out = open_memstream(&result, &size);
    message = (Message){0};
    const bool done = template_fill("page.html", text, values, out, &message);
    fclose(out);
    template_close(values);
    if (done)
        return result;
    free(result);
    return NULL;
}

static void fills(const char *text, const char *wanted)
{
    char *result = filled(text);
    if (!result)
        fail_msg("%s", message.text);
    assert_string_equal(result, wanted);
    free(result);
}

static void refused(const char *text, const char *said)
{
    assert_null(filled(text));
    assert_string_equal(message.text, said);
    assert_true(message.located);
}

TEST(values_are_escaped_or_as_they_are)
{
    fills("", "");
    fills("a { b: ${c} } d\n", "a { b: ${c} } d\n");
    fills("<p>{{title}}</p>", "<p>1 &lt; 2 &amp; &quot;x&quot;&#39;&gt;</p>");
    fills("{{&title}}{{empty}}!", "1 < 2 & \"x\"'>\a!");
}

TEST(sections_repeat)
{
    fills("{{#person}}{{name}}, {{/person}}end", "Ann, Bo, end");
    fills("{{#dog}}a dog{{/dog}}{{^dog}}none{{/dog}}", "none");
    fills("{{#empty}}no{{/empty}}{{^empty}}yes{{/empty}}", "yes");
    fills("{{#title}}{{#person}}.{{/person}}{{/title}}{{^title}}no{{/title}}", "..");
    fills("{{^person}}no{{/person}}", "");
}

TEST(a_section_sees_the_values_around_it_but_not_the_sections)
{
    fills("{{#person}}{{#cat}}{{name}}: {{called}}{{empty}}{{/cat}}{{^cat}}; {{name}}: none{{/cat}}"
          "{{#person}}never{{/person}}{{/person}}",
          "Ann: Tom; Bo: none");
    fills("{{#cat}}never {{called}}{{/cat}}", "");
}

TEST(a_tag_alone_leaves_no_line)
{
    fills("<ul>\n  {{#person}}\n  <li>{{name}}\n  {{/person}}\n</ul>\n{{! all }}\n",
          "<ul>\n  <li>Ann\n  <li>Bo\n</ul>\n");
    fills("a {{! b}} c\n{{#person}} x\n{{/person}}\n", "a  c\n x\n x\n");
    fills("{{#person}}\n{{/person}}", "");
}

TEST(mistakes_are_said_with_their_line)
{
    refused("a\n{{nothing}}", "page.html:2: {{nothing}}: has no value here");
    refused("{{#person}}\n\n{{called}}{{/person}}", "page.html:3: {{called}}: has no value here");
    refused("{{person}}", "page.html:1: {{person}}: has no value here");
    refused("a\n{{#person}}\nb\n", "page.html:4: {{person}}: is not closed");
    refused("{{#dog}}", "page.html:1: {{dog}}: is not closed");
    refused("{{/dog}}", "page.html:1: {{dog}}: closes a section that is not open");
    refused("{{#dog}}{{#person}}{{/dog}}",
            "page.html:1: {{dog}}: closes a section that is not open");
    refused("\n{{title\n}}", "page.html:2: {{title}}: is not closed in its line");
    refused("{{title", "page.html:1: {{title}}: is not closed in its line");
}

FOLDER_TEST(a_file_is_written_whole_or_not_at_all)
{
    static const char gallery[] = "examples/gallery/gallery.html";
    TemplateValues *values = template_values();
    message = (Message){0};
    assert_false(template_write("examples/no/such.html", values, "out.html", &message));
    assert_non_null(strstr(message.text, "such.html: cannot read the template: No such file"));
    assert_null(strchr(message.text, '\n'));
    message = (Message){0};
    require(template_write(gallery, values, "empty.html", &message), &message);
    assert_int_equal(access("empty.html", F_OK), 0);
    template_add(values, "picture");
    assert_false(template_write(gallery, values, "out.html", &message));
    assert_non_null(strstr(message.text, "gallery.html:21: {{name}}: has no value here"));
    assert_int_not_equal(access("out.html", F_OK), 0);
    template_close(values);
}

TEST_MAIN("template", NULL, NULL)
