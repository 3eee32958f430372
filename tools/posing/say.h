// Operations on what a posture says beside its poses: holds, supports, leaders, tangles, texts,
// view. Inner part of tools/posing/edit.h; they throw InputError.
#pragma once

#include "tools/posing/operations.h"

namespace retarget::posing {

void Say(const AddHold& op, TemplatePosture* posture);
void Say(const EditHold& op, TemplatePosture* posture);
void Say(const RemoveHold& op, TemplatePosture* posture);
void Say(const SetSupports& op, TemplatePosture* posture);
void Say(const SetRootLeader& op, TemplatePosture* posture);
void Say(const SetTangles& op, TemplatePosture* posture);
void Say(const SetName& op, TemplatePosture* posture);
void Say(const SetDescription& op, TemplatePosture* posture);
void Say(const SetTags& op, TemplatePosture* posture);
void Say(const SetPhoto& op, TemplatePosture* posture);
void Say(const SetCamera& op, TemplatePosture* posture);

}  // namespace retarget::posing
