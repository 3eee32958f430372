// One requirement and whether it is met, as in report.json and in the studio's replies.

export interface Requirement {
  name: string;
  value: number;
  limit: number;
  unit: string;
  met: boolean;
  where: string;
}
