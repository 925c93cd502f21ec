// Why a tag has no value, in words: "tank does not answer any more".

import type { Unread } from '../lib/unread';
import { t } from './texts';

export const whyUnread = ({ device, why }: Unread): string => t(`unread_${why}`, { device });
