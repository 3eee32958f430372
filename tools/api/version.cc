#include "tools/api/version.h"

namespace retarget::api {

const char* const kVersion = RETARGET_VERSION;
const char* const kGenerator = "retarget " RETARGET_VERSION;

}  // namespace retarget::api
