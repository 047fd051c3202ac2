/* Fuzzes the OFF reader, and with it the detection of formats. */
#include "reader.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    dp_fuzz_reader(data, size, "model.off", DP_FORMAT_AUTO);
    return dp_fuzz_reader(data, size, NULL, DP_FORMAT_OFF);
}
