/*
 * The readers of settings and of the table of efficient ones: any bytes are a table or are refused
 * with a message; a setting that was read is written as text that reads back the same.
 */
#include "efficient.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void check_setting(const Setting *setting)
{
    char text[SETTING_TEXT_SIZE];
    Setting again;
    setting_text(setting, text);
    if (!setting_parse(&again, text, NULL) || !setting_equal(setting, &again))
        abort();
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static Efficient table;
    char text[512];
    Setting setting;
    Message message = {0};
    if (efficient_parse(&table, "fuzzed.csv", (const char *)data, size, &message)) {
        for (int i = 0; i < table.count; i++)
            check_setting(&table.rows[i].setting);
        for (int class = 0; class < SCENE_CLASS_COUNT; class ++)
            efficient_choose(&table, (SceneClass) class, 1, NULL);
    } else if (!message.text[0]) {
        abort();
    }
    if (size < sizeof text) {
        memcpy(text, data, size);
        text[size] = '\0';
        if (setting_parse(&setting, text, NULL))
            check_setting(&setting);
    }
    return 0;
}
