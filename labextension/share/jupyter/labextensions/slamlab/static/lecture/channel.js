// Channel between the deck and the presenter window, named by the notebook, so that each can be
// reloaded without the other.

export const channelOf = (path) => new BroadcastChannel(`slamlab-lecture:${path}`);
