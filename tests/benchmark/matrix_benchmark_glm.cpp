#include "benchmark/matrix_benchmark.h"

#include <glm/glm.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/gtc/type_ptr.hpp>

#include <cstring>

void glm_inverse(const Batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        const glm::mat4 result = glm::inverse(glm::make_mat4(batch->floats[i]));
        std::memcpy(batch->float_results[i], glm::value_ptr(result), sizeof result);
    }
}

void glm_inverse_double(const Batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        const glm::dmat4 result = glm::inverse(glm::make_mat4(batch->doubles[i]));
        std::memcpy(batch->double_results[i], glm::value_ptr(result), sizeof result);
    }
}

void glm_normal(const Batch *batch)
{
    for (int i = 0; i < batch->count; i++) {
        const glm::mat4 result(glm::inverseTranspose(glm::mat3(glm::make_mat4(batch->floats[i]))));
        std::memcpy(batch->float_results[i], glm::value_ptr(result), sizeof result);
    }
}
