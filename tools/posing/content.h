// Operations on the content of a posture beside its poses: holds, supports, leaders, tangles,
// texts, view. Inner part of tools/posing/edit.h; they throw InputError.
#pragma once

#include "tools/posing/operations.h"

namespace retarget::posing {

void Apply(const AddHold& op, TemplatePosture* posture);
void Apply(const EditHold& op, TemplatePosture* posture);
void Apply(const RemoveHold& op, TemplatePosture* posture);
void Apply(const SetSupports& op, TemplatePosture* posture);
void Apply(const SetRootReference& op, TemplatePosture* posture);
void Apply(const SetTangles& op, TemplatePosture* posture);
void Apply(const SetName& op, TemplatePosture* posture);
void Apply(const SetDescription& op, TemplatePosture* posture);
void Apply(const SetTags& op, TemplatePosture* posture);
void Apply(const SetPhoto& op, TemplatePosture* posture);
void Apply(const SetCamera& op, TemplatePosture* posture);

}  // namespace retarget::posing
