// What the deck and the presenter's window speak through: named by the notebook, so that each may be
// loaded again without the other.

export const channelOf = (path) => new BroadcastChannel(`slamlab-lecture:${path}`);
