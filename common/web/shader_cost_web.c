/* Operations are counted by glslang, a process. */
#include "scene/shader_cost.h"

bool shader_cost(const char *text, ShaderStage stage, ShaderCost *cost, Message *message)
{
    (void)text, (void)stage;
    *cost = (ShaderCost){.arithmetic = 0};
    return message_set(message, "operations: not counted in the browser; the command counts them");
}
